// Transport controls: play button, speed, time slider, clock.
import { element, make } from "./dom";
import { fixed } from "./data/numbers";
import type { Desk, Panel } from "./panel";

export class Transport implements Panel {
  private readonly slider = element<HTMLInputElement>("time");
  private readonly button = element<HTMLButtonElement>("play");
  private readonly now = make("b");
  private readonly decimals: number;

  constructor(
    private readonly desk: Desk,
    play: (on: boolean) => void,
    rate: (x: number) => void,
  ) {
    const { end } = desk.recording;
    this.decimals = end < 1 ? 3 : 2;
    this.slider.max = String(end);
    this.slider.addEventListener("input", () => desk.goTo(Number(this.slider.value)));
    this.button.addEventListener("click", () => play(!desk.state.playing));
    const speed = element<HTMLSelectElement>("speed");
    speed.addEventListener("change", () => rate(Number(speed.value)));
    element("clock").append(this.now, ` / ${fixed(end, this.decimals)} s`);
  }

  paint(): void {
    this.seek(this.desk.state.t);
  }

  seek(t: number): void {
    this.slider.value = String(t);
    this.slider.setAttribute("aria-valuetext", `${fixed(t, this.decimals)} seconds`);
    this.now.textContent = fixed(t, this.decimals);
    this.button.classList.toggle("on", this.desk.state.playing);
    this.button.setAttribute("aria-label", this.desk.state.playing ? "Pause" : "Play");
  }
}
