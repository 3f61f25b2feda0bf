// The style of a view, in constructable style sheets: a page's Content-Security-Policy
// `default-src 'self'` allows no others. Pages change it through custom properties and
// parts (docs/embedding.md).

/** The custom element that the runtime puts into each <x3d>. */
export const viewTag = "imgeo-view";

export const viewStyle = sheetOf(`
  :host { position: absolute; inset: 0; display: block; overflow: hidden; contain: strict; }
  :host(:fullscreen) { background: Canvas; }
  canvas { display: block; width: 100%; height: 100%; outline: none; -webkit-tap-highlight-color: transparent; }
  canvas.preview { position: absolute; inset: 0; pointer-events: none; }
  canvas.preview:not(.drawn) { visibility: hidden; }
  canvas.covered { opacity: 0; }
  canvas.moves { cursor: grab; }
  canvas.moves:active { cursor: grabbing; }
  canvas.points-at-link { cursor: pointer; }
  canvas:focus-visible { box-shadow: inset 0 0 0 2px Highlight; outline: 2px solid Highlight; outline-offset: -2px; }

  .poster { position: absolute; inset: 0; display: grid; overflow: hidden; background: var(--poster-color, Canvas); transition: opacity 0.3s; }
  .poster img { width: 100%; height: 100%; min-height: 0; object-fit: cover; }
  .poster.leaving { opacity: 0; pointer-events: none; }

  .bar { position: absolute; inset: 0 0 auto 0; height: var(--progress-bar-height, 3px); pointer-events: none; transition: opacity 0.3s; }
  .bar > div { height: 100%; background: var(--progress-bar-color, #3b82f6); transform-origin: 0 0; transform: scaleX(0); }
  .bar.done { opacity: 0; }

  .controls { position: absolute; inset-block: auto 12px; inset-inline: auto 12px;
              display: flex; flex-wrap: wrap; justify-content: flex-end; gap: 8px; max-width: calc(100% - 24px); }

  select, button { min-height: 44px; max-width: 100%; padding: 0 12px; border: 1px solid color-mix(in srgb, CanvasText 30%, transparent); border-radius: 8px;
           font: 0.9375rem system-ui, sans-serif; color: CanvasText; background: color-mix(in srgb, Canvas 88%, transparent); cursor: pointer; }
  select { max-width: min(100%, 14rem); text-overflow: ellipsis; }

  .tools { display: flex; gap: 2px; border-radius: 8px; transition: opacity 0.2s; }
  .tools button { display: grid; place-items: center; width: 44px; padding: 0; }
  .tools button[aria-pressed="true"] { color: Canvas; background: CanvasText; }
  .tools svg { width: 24px; height: 24px; fill: none; stroke: currentColor; stroke-width: 2; stroke-linecap: round; stroke-linejoin: round; }
  /* With a mouse the picture is free of tools until the mouse is over it; fingers do not hover. Their room is beside or
     above the menus, which are in the corner, and not between the menus and the corner. */
  @media (hover: hover) {
    .tools { order: -1; }
    :host(:not(:hover, :focus-within)) .tools { opacity: 0; }
  }

  select:focus-visible, button:focus-visible { outline: 2px solid Highlight; outline-offset: 2px; }

  .message { position: absolute; inset: 0; display: grid; place-content: center; margin: 0; padding: 1em;
             text-align: center; font: 1rem/1.5 system-ui, sans-serif; background: Canvas; color: CanvasText; }
  .spoken { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
  [hidden] { display: none; }
  @media (prefers-reduced-motion: reduce) { * { transition: none !important; } }
`);

/** Default rules, with a specificity of zero: without them <x3d> is an unknown inline element. */
const pageStyle = sheetOf(`
  :where(x3d, imgeo-viewer) { display: block; position: relative; width: 100%; aspect-ratio: 4 / 3; }
  :where(x3d, imgeo-viewer):where([hidden]) { display: none; }
  :where(x3d) > :where(:not(${viewTag})) { display: none; }
  :where(imgeo-viewer) > :where(x3d) { position: absolute; inset: 0; width: auto; aspect-ratio: auto; }
  :where(imgeo-viewer) > :where(:not(x3d)) { display: none; }
`);

export function adoptPageStyle(root: DocumentOrShadowRoot): void {
  if (!root.adoptedStyleSheets.includes(pageStyle)) root.adoptedStyleSheets.push(pageStyle);
}

export function sheetOf(css: string): CSSStyleSheet {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(css);
  return sheet;
}
