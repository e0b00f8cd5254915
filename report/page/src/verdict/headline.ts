// Verdict of the page: a card per run with the verdict, the reasons for the verdict, and the main numbers of the run.
import { about } from "./about";
import { element, icon, make } from "../dom";
import { events } from "./events";
import type { Fact } from "./facts";
import { folder, word } from "../data/folder";
import type { Overlay } from "../data/format";
import type { Ghost } from "../data/ghost";
import { aside, judgement, type Judgement, type Mood } from "./judgement";
import { fixed, number, sentence } from "../data/numbers";
import type { Desk, Run } from "../panel";
import { signalLink } from "../plots/strays";

const badges: Record<Mood, string> = {
  plan: "M12 6.6v.1M12 11v6.6",
  good: "M5 12.5l4.6 4.6L19 7.5",
  bad: "M6 6l12 12M18 6L6 18",
  open: "M8.6 9.2a3.5 3.5 0 1 1 5.2 3.1c-1.2.7-1.8 1.3-1.8 2.6M12 18.4v.1",
};

export function headline(desk: Desk): void {
  const { ghost } = desk;
  const own = element("verdict");
  if (!ghost?.overlay.strayed) desk.runs.forEach((run, n) => aboveTime(run, ghost?.overlay.labels[n] ?? ""));
  if (!ghost) {
    card(own, desk, judgement(desk), aside(desk.recording.meta));
    return;
  }
  const { overlay } = ghost;
  if (overlay.strayed) {
    card(own, desk, strayed(desk, overlay, overlay.strayed), [
      "A golden contains only the torque, current and angle of every joint and the pose of the base; this page shows " +
        "no more.",
    ]);
  } else {
    cards(own, desk, overlay);
  }
  pair(ghost);
}

/** The events of a run above the time slider, after the name of the run. */
function aboveTime(run: Run, label: string): void {
  const list = make("ol.events");
  list.ariaLabel = `What failed${label && ` in ${label}`}`;
  list.dataset.run = label;
  element("happened").append(list);
  events(list, run);
}

/** Legend of two runs, and a list of their differences. */
function pair({ apart, overlay }: Ghost): void {
  const [a, b] = overlay.labels;
  const both = element("pair");
  both.hidden = false;
  both
    .querySelector("p")!
    .replaceChildren(
      make("span.k", `${a}: solid lines, and the robot in colours`),
      make("span.k.dash", `${b}: dashed lines, and the translucent robot`),
    );
  both.querySelector("ul")!.append(...[...apart, settings(overlay)].map((one) => make("li", one)));
}

/** List of the settings that differ between the runs, or a sentence that the settings are equal. */
function settings({ differs, labels: [a, b], strayed }: Overlay): HTMLElement | string {
  if (!differs.length) {
    return strayed
      ? "Build, engine, step and scenario are the same as in the golden."
      : "Both runs have the same settings.";
  }
  const made = make(
    "details",
    make("summary", strayed ? "Changes since the golden was approved" : `Settings of ${b} that differ from ${a}`),
    make("ul", ...differs.map((one) => make("li", one))),
  );
  made.open = differs.length <= 3;
  return made;
}

/** A card for each of two runs, side by side. */
function cards(own: HTMLElement, desk: Desk, { labels, folders }: Overlay): void {
  const second = own.cloneNode(true) as HTMLElement;
  second.removeAttribute("id");
  for (const one of second.querySelectorAll("[id]")) one.id = `${one.id}-second`;
  own.after(second);
  own.parentElement!.classList.add("two-runs");
  [own, second].forEach((host, n) => {
    const run = desk.runs[n];
    const { meta } = run.recording;
    const place = n ? word(folders[n]) : folder(meta);
    const made = judgement(run, place);
    const tag = make(`span.tag-${n ? "second" : "own"}`, labels[n]);
    host.removeAttribute("aria-labelledby");
    host.setAttribute("aria-label", `${labels[n]}: ${made.said}`); // both may have the same verdict
    card(host, run, { ...made, facts: made.facts.slice(0, 4) }, aside(meta, place));
    host
      .querySelector(".words")!
      .prepend(make("p.whose", tag, make("b", folders[n]), ` ${meta.name} · ${about(meta)}`));
  });
}

function card(host: HTMLElement, run: Run, { mood, said, why, facts }: Judgement, beside: (string | Node)[]): void {
  const part = (name: string) => host.querySelector<HTMLElement>(`.${name}`)!;
  const { missing, overlay } = run.recording.meta;
  host.dataset.mood = mood;
  part("badge").append(icon(badges[mood], 24));
  part("said").textContent = said;
  part("reason").append(...why.flatMap((one, k) => (k ? [" ", one] : [one])));
  events(part("events"), run);
  part("aside").append(...beside.flatMap((one) => [one, " "]));
  part("facts").dataset.count = String(facts.length);
  part("facts").append(
    ...facts.map(([name, value, small]) =>
      make("div", make("dt", name), make("dd", value, ...(small ? [" ", make("small", small)] : []))),
    ),
  );
  part("lacks").hidden = !missing.length || !!overlay?.strayed;
  part("lacks").append(...missing.map((m) => make("li", sentence(m))));
}

/** Judgement of a run that left the bands of its golden, with the first and the largest deviation of a signal. */
function strayed(run: Run, { strays }: Overlay, text: string): Judgement {
  const worst = [...strays].sort((a, b) => b.ratio - a.ratio)[0];
  const facts: Fact[] = [];
  if (strays[0] && strays[0].from !== null) {
    facts.push(["First to leave its band", signalLink(run, strays[0]), `at ${fixed(strays[0].from, 2)} s`]);
  }
  if (worst) facts.push(["Farthest off", signalLink(run, worst), `RMS ${number(worst.ratio)} bands`]);
  return { mood: "bad", said: "The run left the bands of its golden", why: [sentence(text)], facts };
}
