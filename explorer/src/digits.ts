/** A number in a field: four digits to be read, with the focus all that count. */

import { number, parsed } from "./language";

/** What a field has of its value. */
export function digits(value: number): Record<string, unknown> {
  return {
    value: number(value),
    title: number(value, 7),
    onfocus: ({ target }: { target: HTMLInputElement }) => {
      target.value = target.title;
      target.select();
    },
    onblur: ({ target }: { target: HTMLInputElement }) => {
      if (target.value === target.title) target.value = number(parsed(target.value));
    },
  };
}

/** Another value in such a field, which may be typed in just now. */
export function showDigits(field: HTMLInputElement, value: number): void {
  field.title = number(value, 7);
  field.value = field.matches(":focus") ? field.title : number(value);
}
