/** Texts, numbers, links, tables, what is read off, undo. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateRawSync } from "node:zlib";
import german from "../src/de.json";
import { withMinus } from "../src/dom";
import { factsOf } from "../src/facts";
import { History } from "../src/history";
import { Backend, Cancelled, StillModel } from "../src/host";
import { angle, number, parsed, setLanguage, spaced, t } from "../src/language";
import { checksum, packed, unpacked } from "../src/link";
import { Linkage } from "../src/linkage";
import type { Least } from "../src/measures";
import { chainText } from "../src/model";
import { Status } from "../src/status";
import { quoted, tableOf } from "../src/table";
import { stopText } from "../src/wording";
import { CRANK_ROCKER, fourBar } from "./fourbar";
import "./words";

function inGerman(body: () => void): void {
  setLanguage("de");
  try {
    body();
  } finally {
    setLanguage("en");
  }
}

test("texts and their gaps", () => {
  assert.equal(t("Play"), "Play");
  assert.equal(t("Output {name}", { name: "rocker" }), "Output rocker");
  assert.equal(t("{one} {two}", { one: 1 }), "1 {two}");
  inGerman(() => {
    assert.equal(t("Cancel"), "Abbrechen");
    assert.equal(t("Turns back at {value}", { value: "5°" }), "Umkehrlage bei 5°");
    assert.equal(t("a text that nobody translated"), "a text that nobody translated");
  });
  assert.ok(Object.values(german).every((text) => text.trim() !== ""));
});

test("names of documents as they are read", () => {
  const names = ["upper_jaw", "coupler1", "Schwinge2", "Zähler12", "P1", "2"];
  assert.deepEqual(names.map(spaced), ["upper jaw", "coupler 1", "Schwinge 2", "Zähler 12", "P1", "2"]);
});

test("numbers", () => {
  assert.equal(number(1234.5678), "1235");
  assert.equal(number(0.00012347), "0.0001235");
  assert.equal(number(2.5, 7), "2.5");
  assert.equal(number(-0), "0");
  assert.equal(number(NaN), "–");
  assert.equal(number(Infinity), "–");
  assert.equal(angle(Math.PI / 3), "60°");
  assert.equal(angle(1e-12), "0°");
  assert.equal(angle(-Math.PI / 7, 5), "−25.714°");
  inGerman(() => {
    assert.equal(number(2.5), "2,5");
    assert.equal(angle(Math.PI / 8), "22,5°");
  });
});

test("numbers that are typed", () => {
  assert.equal(parsed("2.5"), 2.5);
  assert.equal(parsed(" 2,5 "), 2.5);
  assert.equal(parsed("-1e-3"), -0.001);
  assert.equal(parsed(number(-1.5e-9)), -1.5e-9);
  for (const text of ["", "two", "1 2", "1.2.3", "--1"]) assert.ok(Number.isNaN(parsed(text)), text);
});

test("links", async () => {
  assert.equal(checksum(new TextEncoder().encode("123456789")), "cbf43926"); // the check value of CRC-32
  const content = { document: { joints: "R(a-b)" }, name: "Ä €", drive: 0.1 + 0.2 };
  const text = await packed(content);
  assert.ok(/^1\.[\w-]+\.[0-9a-f]{8}$/.test(text));
  assert.deepEqual(await unpacked(text), content);
  const raw = deflateRawSync(new TextEncoder().encode('{"a":[1,2]}'));
  const base64 = btoa(String.fromCharCode(...raw))
    .replaceAll("+", "-")
    .replaceAll("/", "_")
    .replaceAll("=", "");
  assert.deepEqual(await unpacked(`1.${base64}.${checksum(raw)}`), { a: [1, 2] });
});

test("links that cannot be read say why", async () => {
  const [version, data, sum] = (await packed({ a: 1 })).split(".") as [string, string, string];
  const says = (text: string, words: string) =>
    assert.rejects(unpacked(text), (error) => (error as Error).message.includes(words));
  await says(`2.${data}.${sum}`, "newer version");
  await says(`${version}.${data}`, "not complete");
  await says(`${version}.${data}.00000000`, "damaged");
  await says(`${version}.${data.slice(0, -2)}.${sum}`, "damaged");
});

test("the chain as text", () => {
  const text = "R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker); frame=frame; drive=R(frame-crank)";
  assert.equal(chainText(fourBar(CRANK_ROCKER, 1)), text);
});

test("the table of a four-bar", () => {
  // shown at 1 rad, it begins at 0 and has a row for each degree
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 1));
  const [head, first, ...others] = tableOf(linkage).split("\n");
  const output = "rocker [°],rocker′,rocker′′ [1/rad],Transmission angle μ [°]";
  const point = "K x [mm],K y [mm],K vx [mm/rad],K vy [mm/rad],K ax [mm/rad²],K ay [mm/rad²]";
  assert.equal(head, `R(frame-crank) [°],${output},${point}`);
  const [drive, psi, slope, , mu, x] = first!.split(",").map(Number);
  assert.equal(drive, 0);
  const degrees = (cosine: number) => (Math.acos(cosine) * 180) / Math.PI;
  assert.ok(Math.abs(mu! - degrees((70 ** 2 + 40 ** 2 - 45 ** 2) / (2 * 70 * 40))) < 1e-4);
  assert.ok(Math.abs(psi! - (180 - degrees((45 ** 2 + 40 ** 2 - 70 ** 2) / (2 * 45 * 40)))) < 1e-4);
  // the pole of crank and rocker is where the coupler meets the frame: B itself lies on it, 25 from A and 45 from D
  assert.ok(Math.abs(slope! + 25 / 45) < 1e-5);
  // C is above BD, which lies along the frame: the angle of the coupler is that of the triangle 70, 45, 40
  const phi = Math.acos((70 ** 2 + 45 ** 2 - 40 ** 2) / (2 * 70 * 45));
  assert.ok(Math.abs(x! - (25 + 35 * Math.cos(phi))) < 1e-4);
  assert.equal(others.length, 360); // 359 more rows, and the end of the last line
  assert.deepEqual(
    [others[0], others[358]].map((row) => row!.split(",")[0]),
    ["1", "359"],
  );
  const cells = [first!, ...others].flatMap((row) => row.split(",").map(Number));
  assert.ok(cells.every((cell) => Number(cell.toPrecision(6)) === cell));
  assert.equal(quoted('a "b", c'), '"a ""b"", c"');
  assert.equal(quoted("K x [mm]"), "K x [mm]");
});

test("a table takes further columns, read at its own places of the drive", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 1));
  // a straight line from 5 N at 0 to 365 N after a turn: as many as degrees, and 5 more
  const [head, ...rows] = tableOf(linkage, [
    ["frame on crank Fx", "N", Float64Array.of(0, 2 * Math.PI), Float64Array.of(5, 365)],
  ]).split("\n");
  assert.ok(head!.endsWith(",frame on crank Fx [N]"));
  assert.deepEqual(
    [0, 90, 359].map((row) => rows[row]!.split(",").at(-1)),
    ["5", "95", "364"],
  );
});

test("what is read off a four-bar", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 0));
  const dead = [
    { value: 3.7, output: 2.5 },
    { value: 0.385, output: 1.1 },
  ];
  const found = { dead, travel: 1.4, least: { value: 0, mu: 0.65, leg: null as Least["leg"] } };
  const facts = () =>
    factsOf(linkage, found, (value) => value).map(({ name, text, style, note }) => [name, text, style ?? note ?? ""]);
  // psi: 180 degrees less the angle at D of the triangle 45, 40, 70
  const [[title, psi], , ...others] = facts() as [[string, string, string], unknown, ...unknown[]];
  assert.equal(title, "Output rocker");
  assert.equal(
    psi,
    `${(180 - (Math.acos((45 ** 2 + 40 ** 2 - 70 ** 2) / (2 * 45 * 40)) * 180) / Math.PI).toPrecision(4)}°`,
  );
  // the law of cosines: acos((70^2 + 40^2 - 45^2) / (2 70 40)) = 36.955 degrees
  // 1.4 of a radian; (3.7 - 0.385) / (2 pi - 3.315)
  assert.deepEqual(others, [
    ["Swing", "80.21°", ""],
    ["Time ratio", "1.117", ""],
    ["Transmission angle μ", "36.96°", "bad"],
    ["Smallest μ", "37.24°", "bad"],
    ["Dead centres", "22.06°, 212°", ""],
    ["Range of the drive", "full turns", ""],
  ]);
  const where = () => factsOf(linkage, found, (value) => value).find(({ name }) => name === "Smallest μ")!.note;
  assert.equal(where(), "throughout");
  found.least.leg = linkage.model.outputs[0]!.legs[0]!;
  assert.equal(where(), "at 0°");
  linkage.model.outputs[0]!.inLine = false; // then it turns back without crank and coupler in line
  assert.deepEqual(facts()[6], ["Turns back at", "22.06°, 212°", ""]);
  linkage.model.own = 6;
  assert.equal(where(), "at 0°, link coupler");
  inGerman(() => assert.equal(facts()[0]![0], "Abtrieb Schwinge"));
});

test("why a motion ends", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 0));
  const stop = { value: Math.PI / 2, status: Status.LIMIT, form: "RRR", links: ["coupler", "rocker"] };
  const said = "there the joints of coupler and rocker no longer meet.";
  assert.equal(stopText(linkage, stop), `The motion ends at 90°: ${said}`);
  const third = { ...stop, value: Math.PI / 3 + 0.001 }; // 60.0573 degrees, in four digits as the library says it
  assert.equal(stopText(linkage, third), `The motion ends at 60.06°: ${said}`);
  const open = { ...stop, status: "open" as const, form: "R(a-b)", links: [] };
  assert.equal(stopText(linkage, open), "The motion ends at 90°: there R(a-b) is open.");
  inGerman(() => {
    const text = stopText(linkage, stop);
    assert.ok(text.includes("bei 90°") && text.includes("von Koppel und Schwinge"), text);
  });
});

test("undo and redo", () => {
  const history = new History<string>();
  assert.deepEqual(history.possible, [false, false]);
  assert.equal(history.undo("now"), undefined);
  history.add("one");
  history.add("two");
  assert.equal(history.undo("three"), "two");
  assert.equal(history.undo("two"), "one");
  assert.deepEqual(history.possible, [false, true]);
  assert.equal(history.redo("one"), "two");
  history.add("other");
  assert.deepEqual(history.possible, [true, false]);
  for (let k = 0; k < 300; k++) history.add(String(k));
  let count = 0;
  while (history.undo("") !== undefined) count++;
  assert.equal(count, 200);
});

test("requests are answered, refused, cancelled", async () => {
  const sent: { id: number; method?: string; lang?: string; cancel?: boolean }[] = [];
  class Model extends StillModel {
    override send(content: unknown): void {
      sent.push(content as (typeof sent)[number]);
    }
    answer(content: unknown): void {
      this.emit("msg:custom", content);
    }
  }
  const model = new Model({ host: "server" });
  const backend = new Backend(model);
  assert.ok(backend.present);
  const told: string[] = [];
  const first = backend.ask<number>("count", {}, "de", (text) => told.push(text));
  const second = backend.ask("describe", {}, "en");
  const third = backend.ask("find", {}, "en");
  third.cancel();
  assert.deepEqual(
    sent.map(({ id, method, lang, cancel }) => [id, method ?? "", lang ?? "", cancel ?? false]),
    [
      [1, "count", "de", false],
      [2, "describe", "en", false],
      [3, "find", "en", false],
      [3, "", "", true],
    ],
  );
  model.answer({ id: 1, progress: "half" });
  model.answer({ id: 2, error: "no" });
  model.answer({ id: 3, cancelled: true });
  model.answer({ id: 1, result: 5 });
  assert.equal(await first, 5);
  assert.deepEqual(told, ["half"]);
  await assert.rejects(second, (error) => (error as Error).message === "no");
  await assert.rejects(third, (error) => error instanceof Cancelled);
  assert.equal(new Backend(new StillModel({ host: "file" })).present, false);
});

test("texts of the library get a minus sign as long as the plus; names and words keep their hyphens", () => {
  assert.equal(withMinus("F = 3(n - 1) - 2 g1 = -2"), "F = 3(n − 1) − 2 g1 = −2");
  assert.equal(withMinus("R(1-2) crank-rocker, 0-1"), "R(1-2) crank-rocker, 0-1");
});
