// The pointer events that a <shape> gets: copies of the browser's events, with the hit as
// additional properties.

import type { Hit } from "../render/picking/picker.ts";

/** A point or direction in scene coordinates; as a string an SFVec3f. */
export interface Vector3D {
  readonly x: number;
  readonly y: number;
  readonly z: number;
  toString(): string;
}

/** Additional properties of pointer events on shapes. */
export interface ShapeEventProperties {
  readonly worldPosition: Vector3D;
  /** Unit vector; null on points and lines without normals. */
  readonly worldNormal: Vector3D | null;
  /**
   * How far the mesh may be from `worldPosition`, in the scene's units: 0 where the mesh itself is drawn, the stated
   * error in coarse forms of levels of detail; null while the patch loads.
   */
  readonly accuracy: number | null;
  /**
   * Index of the geometry's patch, or number of the group in levels of detail. `vertexId` and `triangleId` are indices
   * within it.
   */
  readonly patch: number;
  /** Index of the nearest vertex of the primitive that was hit. */
  readonly vertexId: number;
  /** Null on points and lines, and on coarse forms. */
  readonly triangleId: number | null;
  /** The element of the shape, which may be in an inlined document: the target of the event is then the Inline. */
  readonly shapeElement: Element;
  /** The following repeat the above under X3DOM's names. */
  readonly hitObject: Element;
  readonly hitPnt: readonly [number, number, number];
  readonly worldX: number;
  readonly worldY: number;
  readonly worldZ: number;
  readonly normalX: number;
  readonly normalY: number;
  readonly normalZ: number;
}

export type ShapePointerEvent = PointerEvent & ShapeEventProperties;

export function vector3DOf({ x, y, z }: { x: number; y: number; z: number }): Vector3D {
  return Object.freeze({ x, y, z, toString: () => `${x} ${y} ${z}` });
}

/** A copy of `native` with another type; without a hit it has no additional properties. */
export function shapePointerEventOf(
  native: PointerEvent | MouseEvent,
  type: string,
  hit: Hit | undefined,
  relatedTarget: EventTarget | null = native.relatedTarget,
): MouseEvent {
  const isEnterOrLeave = type.endsWith("enter") || type.endsWith("leave");
  const common = {
    ...initOf(native, mouseFields),
    relatedTarget,
    bubbles: !isEnterOrLeave,
    cancelable: !isEnterOrLeave,
    composed: true,
  };
  const event =
    type.startsWith("mouse") || !(native instanceof PointerEvent)
      ? new MouseEvent(type, common)
      : new PointerEvent(type, { ...common, ...initOf(native, pointerFields) });
  return hit ? Object.assign(event, propertiesOf(hit)) : event;
}

const mouseFields = [
  "view",
  "detail",
  "screenX",
  "screenY",
  "clientX",
  "clientY",
  "movementX",
  "movementY",
  "ctrlKey",
  "shiftKey",
  "altKey",
  "metaKey",
  "button",
  "buttons",
] as const;
const pointerFields = [
  "pointerId",
  "width",
  "height",
  "pressure",
  "tangentialPressure",
  "tiltX",
  "tiltY",
  "twist",
  "pointerType",
  "isPrimary",
] as const;

function initOf<Source, Name extends keyof Source>(source: Source, names: readonly Name[]): Pick<Source, Name> {
  return Object.fromEntries(names.map((name) => [name, source[name]])) as Pick<Source, Name>;
}

function propertiesOf({
  element,
  shape,
  patch,
  triangle,
  vertex,
  position,
  normal,
  accuracy,
}: Hit): ShapeEventProperties {
  const { x, y, z } = position;
  return {
    worldPosition: vector3DOf(position),
    worldNormal: normal ? vector3DOf(normal) : null,
    accuracy: accuracy ?? null,
    patch,
    vertexId: vertex,
    triangleId: triangle ?? null,
    shapeElement: shape as Element,
    hitObject: element as Element,
    hitPnt: [x, y, z],
    worldX: x,
    worldY: y,
    worldZ: z,
    normalX: normal?.x ?? 0,
    normalY: normal?.y ?? 0,
    normalZ: normal?.z ?? 0,
  };
}
