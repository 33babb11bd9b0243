import { icon, make } from "./dom.js";

const KEYS = [
  ["space", "pause, resume"],
  ["s  →", "one step"],
  ["←", "one frame back (recording)"],
  ["r", "reset"],
  ["c", "next colour"],
  ["v", "surface, particles and springs"],
  ["f", "fit the view"],
  ["g", "a finger pulls the body"],
  ["p", "panel"],
  ["o", "open a recording"],
  ["?", "this help"],
];
const POINTER = [
  ["drag the body", "pull it; a finger: press long first"],
  ["drag beside it", "turn the view (Shift: anywhere)"],
  ["scroll, pinch", "zoom"],
  ["right drag, two fingers", "move the view"],
  ["drop an .mcap", "play a recording"],
];

/** Fills the help's dialog. */
export function fillHelp(dialog) {
  const table = (rows, Key) =>
    make("dl", {}, ...rows.flatMap(([key, text]) => [make("dt", {}, ...key.split("  ").map((part) => make(Key, {}, part))), make("dd", {}, text)]));
  dialog.append(
    make("h2", {}, "flexcast", make("button", { class: "tiny", "aria-label": "Close", onclick: () => dialog.close() }, icon("close"))),
    make("p", {}, "A soft-body simulation, live. The server simulates; this page draws the newest of its frames and sends it commands. Each is answered after its effect, with the step."),
    make("h3", {}, "Pointer"),
    table(POINTER, "span"),
    make("h3", {}, "Keyboard"),
    table(KEYS, "kbd"),
  );
  dialog.addEventListener("click", ({ target }) => target === dialog && dialog.close());
}
