// Reads Background and TextureBackground.

import type { BackgroundNodeDescription, PanoramaPicture, PanoramaSide, SamplingDescription } from "./description.ts";
import { panoramaSides } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { lowerNameOf } from "./element.ts";
import type { Vec3 } from "./fieldTypes.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import type { ChildrenOf } from "./readImage.ts";
import { edgeToEdge, fieldOf, isTexture, readImageOf } from "./readImage.ts";

/** `element`: the node's identity; `node`: the element with its fields. */
export function readBackground(
  element: SceneElement,
  node: SceneElement,
  inlineDepth: number,
  childrenOf: ChildrenOf,
  warnings: Warning[],
): BackgroundNodeDescription {
  const fields = readFields(node, nodeFields.TextureBackground, warnings);
  const { skyColor, skyAngle, groundColor, groundAngle, transparency } = fields;
  return {
    kind: "background",
    element,
    inlineDepth,
    isBindRequested: fields.set_bind || fields.bind,
    background: {
      sky: ringsOf(skyColor.length > 0 ? skyColor : [[0, 0, 0]], skyAngle),
      ground: ringsOf(groundColor, groundAngle),
      transparency: Math.min(Math.max(transparency, 0), 1),
      pictures:
        lowerNameOf(node) === "background"
          ? picturesByUrl(node, warnings)
          : picturesIn(childrenOf(node), childrenOf, warnings),
    },
  };
}

/** The first color is at the pole, each further one at its angle. */
function ringsOf(colors: readonly Vec3[], angles: readonly number[]) {
  return colors.slice(0, angles.length + 1).map((color, i) => ({ color, angle: i === 0 ? 0 : (angles[i - 1] ?? 0) }));
}

const smooth: SamplingDescription = { isData: false, ...edgeToEdge, isSmooth: true, hasMipmaps: true, anisotropy: 1 };

function picturesByUrl(node: SceneElement, warnings: Warning[]): PanoramaPicture[] {
  const fields = readFields(node, nodeFields.Background, warnings);
  return panoramaSides.flatMap((role) => {
    const urls = fields[`${role}Url`];
    return urls.length === 0 ? [] : [{ role, urls, preview: "", sampling: smooth }];
  });
}

/** The pictures of a TextureBackground, whose containerField says the side. */
function picturesIn(textures: readonly SceneElement[], childrenOf: ChildrenOf, warnings: Warning[]): PanoramaPicture[] {
  return panoramaSides.flatMap((role: PanoramaSide) => {
    const texture = textures.find((each) => isTexture(each) && fieldOf(each) === `${role}texture`);
    const image = texture && readImageOf(texture, childrenOf, warnings);
    return image ? [{ ...image, role, sampling: { ...image.sampling, ...edgeToEdge } }] : [];
  });
}
