// What people see of a view besides the picture: a thin bar, a message. All
// style stands in constructable sheets: the page's `default-src 'self'` allows
// no other.

export interface Face {
  readonly canvas: HTMLCanvasElement;
  /** 0 … 1; at 1 the bar goes away. */
  showProgress(share: number): void;
  /** Instead of the picture. */
  showMessage(text: string): void;
}

const viewStyle = sheetOf(`
  :host { position: absolute; inset: 0; display: block; overflow: hidden; contain: strict; }
  canvas { display: block; width: 100%; height: 100%; touch-action: none; outline: none; cursor: grab; }
  canvas:active { cursor: grabbing; }
  canvas:focus-visible { box-shadow: inset 0 0 0 2px Highlight; outline: 2px solid Highlight; outline-offset: -2px; }
  .bar { position: absolute; inset: 0 0 auto 0; height: 3px; pointer-events: none; }
  .bar > div { height: 100%; background: #3b82f6; transform-origin: 0 0; transform: scaleX(0); }
  .message { position: absolute; inset: 0; display: grid; place-content: center; margin: 0; padding: 1em;
             text-align: center; font: 1rem/1.5 system-ui, sans-serif; background: Canvas; color: CanvasText; }
  [hidden] { display: none; }
`);

/** A default that any rule of the page outweighs: <x3d> is an unknown inline element otherwise. */
const pageStyle = sheetOf(`
  :where(x3d) { display: block; position: relative; width: 100%; aspect-ratio: 4 / 3; }
  :where(x3d) > :where(:not(imgeo-view)) { display: none; }
`);

export function stylePage(document: Document): void {
  if (!document.adoptedStyleSheets.includes(pageStyle)) document.adoptedStyleSheets.push(pageStyle);
}

export function makeFace(root: ShadowRoot, label: string): Face {
  root.adoptedStyleSheets = [viewStyle];
  const canvas = document.createElement("canvas");
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", label);
  canvas.setAttribute("aria-description",
    "Arrow keys turn, with Shift they move, plus and minus zoom, R goes back to the start, A shows all.");

  const bar = document.createElement("div");
  const fill = document.createElement("div");
  bar.className = "bar";
  bar.setAttribute("role", "progressbar");
  bar.setAttribute("aria-label", "Loading");
  bar.append(fill);

  const message = document.createElement("p");
  message.className = "message";
  message.setAttribute("role", "alert");
  message.hidden = true;
  root.append(canvas, bar, message);

  return {
    canvas,
    showProgress(share) {
      fill.style.transform = `scaleX(${share})`;
      bar.setAttribute("aria-valuenow", String(Math.round(share * 100)));
      bar.hidden = share >= 1;
    },
    showMessage(text) {
      canvas.hidden = true;
      bar.hidden = true;
      message.hidden = false;
      message.textContent = text;
    },
  };
}

function sheetOf(css: string): CSSStyleSheet {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(css);
  return sheet;
}
