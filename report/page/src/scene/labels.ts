// Labels in front of the 3D picture. If two labels overlap, only the first is shown.

interface Label {
  text: string;
  x: number;
  y: number;
}

export class Labels {
  private readonly spans: HTMLElement[] = [];

  constructor(private readonly host: HTMLElement) {}

  show(labels: Label[]): void {
    while (this.spans.length < labels.length) this.spans.push(this.host.appendChild(document.createElement("span")));
    const taken: [number, number, number, number][] = [];
    this.spans.forEach((span, i) => {
      const label = labels[i];
      const half = label ? 3.4 * label.text.length + 4 : 0;
      if (label) label.x = Math.min(Math.max(label.x, half), Math.max(this.host.clientWidth - half, half));
      const free =
        !!label && !taken.some(([x, y, w, h]) => Math.abs(x - label.x) < w + half && Math.abs(y - label.y) < h + 8);
      span.hidden = !free;
      if (!label || !free) return;
      taken.push([label.x, label.y, half, 8]);
      if (span.textContent !== label.text) span.textContent = label.text;
      span.style.transform = `translate(calc(${label.x.toFixed(1)}px - 50%), calc(${label.y.toFixed(1)}px - 50%))`;
    });
  }
}
