// The style of the overlays, beside that of the view (element/viewStyle.ts).

import { sheetOf } from "../element/viewStyle.ts";

export const overlayStyle = sheetOf(`
  .hotspots { position: absolute; inset: 0; overflow: hidden; pointer-events: none; }
  .hotspots > div { position: absolute; left: 0; top: 0; width: 0; height: 0; display: grid; place-content: center;
                    place-items: center; }
  .hotspots ::slotted(*) { width: max-content; max-width: 16rem; pointer-events: auto;
                           opacity: var(--max-hotspot-opacity, 1); transition: opacity 0.2s; }
  .hotspots > .unseen ::slotted(*) { opacity: var(--min-hotspot-opacity, 0.25); pointer-events: none; }
  .hotspots > .displaced ::slotted(:not(:focus)) { opacity: 0; pointer-events: none; }
  .hotspots > .out-of-view { visibility: hidden; }

  .links { position: absolute; inset: 12px 12px auto 12px; pointer-events: none; }
  .links a { position: absolute; box-sizing: border-box; width: max-content; max-width: 100%; padding: 12px;
             border-radius: 8px;
             font: 0.9375rem system-ui, sans-serif; color: LinkText; background: Canvas; overflow-wrap: anywhere; }
  .links a:focus { pointer-events: auto; }
  .links a:not(:focus) { clip-path: inset(50%); }
  .links a:focus-visible { outline: 2px solid Highlight; outline-offset: 2px; }

  .help { box-sizing: border-box; width: min(32rem, calc(100vw - 24px)); max-height: calc(100dvh - 24px);
          overflow: auto; padding: 16px; border: 0; border-radius: 12px;
          font: 1rem/1.5 system-ui, sans-serif; color: CanvasText; background: Canvas; }
  .help::backdrop { background: rgb(0 0 0 / 0.5); }
  .help h2 { margin: 0 0 8px; font-size: 1.125rem; }
  .help table { width: 100%; margin-bottom: 16px; border-collapse: collapse; }
  .help th, .help td { padding: 4px 12px 4px 0; text-align: start; vertical-align: top; font-weight: normal; }
  .help th { width: 50%; color: color-mix(in srgb, CanvasText 75%, transparent); }
  .help button { width: 100%; }
`);
