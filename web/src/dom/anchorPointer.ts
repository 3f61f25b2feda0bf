// Lets pointers use the links of a scene's Anchors: the cursor and a tooltip show a link, and a click on a shape in it
// follows it. Shapes get the pointer's events first.

import type { AnchorDescription } from "../document/description.ts";
import type { Hit } from "../render/picking/picker.ts";
import type { OverlaidView } from "./overlays.ts";
import type { LateOverlays } from "./lateOverlays.ts";
import { sendShapePointerEvents } from "./shapePointerEvents.ts";

/** Listens until the view is disposed of. */
export function followAnchorsByPointer(
  { host, ui: { canvas }, viewer: { renderer }, signal }: OverlaidView,
  overlays: LateOverlays,
): void {
  const anchorAround = ({ group }: Hit): AnchorDescription | undefined => renderer.scene.shapes.anchorAround(group);
  sendShapePointerEvents(
    canvas,
    host,
    renderer.picker,
    {
      onHover: (hit) => {
        const anchor = hit && anchorAround(hit);
        const link = anchor && overlays.loaded?.links.of(anchor);
        canvas.classList.toggle("points-at-link", link !== undefined);
        canvas.title = link?.textContent ?? "";
      },
      onClick: (hit, native) => {
        const anchor = anchorAround(hit);
        if (anchor)
          overlays.use(({ links }) => {
            links.follow(anchor, native);
          });
      },
    },
    signal,
  );
}
