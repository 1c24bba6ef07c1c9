/** A number in a field: four digits to be read, with the focus all that count. */

import { number, parsed } from "./language";

/** What a field has of its value; with the focus alone what rounding leaves of 0 beside larger ones. */
export function digits(value: number, others: readonly number[] = []): Record<string, unknown> {
  const least = 1e-4 * Math.max(...others.map(Math.abs));
  const shown = (own: number) => {
    const text = number(own);
    // what was typed has few digits
    return Math.abs(own) < least && text !== number(own, 7) ? "0" : text;
  };
  return {
    value: shown(value),
    title: number(value, 7),
    onfocus: ({ target }: { target: HTMLInputElement }) => {
      target.value = target.title;
      target.select();
    },
    onblur: ({ target }: { target: HTMLInputElement }) => {
      if (target.value === target.title) target.value = shown(parsed(target.value));
    },
  };
}

/** Another value in such a field, which may be typed in just now. */
export function showDigits(field: HTMLInputElement, value: number): void {
  field.title = number(value, 7);
  field.value = field.matches(":focus") ? field.title : number(value);
}
