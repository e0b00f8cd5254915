// Fragment of the page's address with the joint and time shown (#joint=m3/active&t=1.2), so that a link can be copied.
import type { Desk } from "./panel";

export class Address {
  readonly link = new URLSearchParams(location.hash.slice(1));
  private waiting = 0;

  /** Writes joint and time into the address after 400 ms, because browsers limit the rate of changes. */
  remember(desk: Desk): void {
    clearTimeout(this.waiting);
    if (this.link.has("paused") || !desk.recording.ran) return;
    this.waiting = window.setTimeout(() => write(desk), 400);
  }
}

function write({ recording, state }: Desk): void {
  const joint = recording.meta.joints[state.joint]?.name;
  const parts = [
    ...(joint ? [`joint=${encodeURIComponent(joint).replaceAll("%2F", "/")}`] : []),
    `t=${+state.t.toFixed(3)}`,
  ];
  try {
    history.replaceState(null, "", `#${parts.join("&")}`);
  } catch {
    // A page that is embedded in another page may not change the address.
  }
}
