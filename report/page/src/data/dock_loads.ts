// Loads of the docks at each row, as a share of their strength, or of the largest load in the run.
import type { Values } from "./channels";
import { largest } from "./loads";
import type { Recording } from "./recording";

const kinds = ["tension", "shear", "bending", "torsion"];

export class DockLoads {
  /** True if shares refer to the strengths of the docks, false if shares refer to the largest loads of the run. */
  readonly limited: boolean;
  readonly any: boolean;
  private readonly parts: { values: Values; scale: number; signed: boolean }[][];

  constructor(private readonly recording: Recording) {
    const { docks, modules, verdict } = recording.meta;
    const found = kinds.filter((kind) => recording.has(`dock.0.${kind}`));
    // A check has the limit of its worst dock, which is the limit of every dock if all modules have one type.
    const alike = new Set(modules.map((m) => m.type)).size === 1;
    const limit = (kind: string) =>
      alike ? (verdict.checks?.find((c) => c.id === `dock_${kind}` && c.value !== null)?.limit ?? null) : null;
    this.any = found.length > 0;
    this.limited = found.some((kind) => limit(kind) !== null);
    const used = this.limited ? found.filter((kind) => limit(kind) !== null) : found;
    const values = (dock: number, kind: string) => recording.channel(`dock.${dock}.${kind}`);
    const scales = used.map((kind) => limit(kind) ?? Math.max(1e-9, ...docks.map((_, n) => largest(values(n, kind)))));
    this.parts = docks.map((_, n) =>
      used.map((kind, k) => ({ values: values(n, kind), scale: scales[k], signed: kind === "tension" })),
    );
  }

  /** Largest share of the loads of a dock, 0 to 1. A dock that is pushed together has no tension. */
  shareAt(dock: number, t: number): number {
    const shares = this.parts[dock].map(({ values, scale, signed }) => {
      const value = this.recording.at(values, t);
      return (signed ? Math.max(value, 0) : Math.abs(value)) / scale;
    });
    return Math.min(1, Math.max(0, ...shares));
  }
}
