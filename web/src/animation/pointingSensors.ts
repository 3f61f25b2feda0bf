// X3D's pointing device sensors (ISO/IEC 19775-1, clause 20). They get rays and points in their own coordinates from
// whoever follows the pointer.

import type { Behaviour, EventNode, FieldSpecification } from "./eventNode.ts";
import type { NodeType } from "./nodeType.ts";
import { inputOutput, nodeType, outputOnly } from "./nodeType.ts";
import type { Point, Ray } from "./rays.ts";
import { onCylinder, onPlane, onSphere } from "./rays.ts";
import type { Quaternion } from "./rotations.ts";
import { conjugate, multiply, quaternionOf, rotationBetween, rotationOf, turned } from "./rotations.ts";

/** A point on a shape under the pointer. */
export interface PointedAt {
  readonly point: Point;
  /** Unit vector; undefined on points and lines. */
  readonly normal: Point | undefined;
}

export abstract class PointingSensor implements Behaviour {
  /** Whether it follows the pointer while a button is down, so that the camera must not. */
  readonly isDragged: boolean = true;
  protected readonly node: EventNode;

  constructor(node: EventNode) {
    this.node = node;
  }

  get isEnabled(): boolean {
    return this.node.isTrue("enabled");
  }

  get isActive(): boolean {
    return this.node.isTrue("isActive");
  }

  receive(field: string): void {
    if (field !== "enabled" || this.isEnabled) return;
    if (this.isActive) this.node.send("isActive", false);
    if (this.node.isTrue("isOver")) this.node.send("isOver", false);
  }

  /** The pointer is on a shape of the sensor's group, or not any longer. */
  over(at: PointedAt | undefined): void {
    const isOver = at !== undefined;
    if (isOver !== this.node.isTrue("isOver")) this.node.send("isOver", isOver);
  }

  press(at: PointedAt, ray: Ray): void {
    this.node.send("isActive", true);
    this.begin(at, ray);
  }

  /** `isOver`: whether the pointer is on a shape of the sensor's group. `time` in seconds. */
  release(isOver: boolean, time: number): void {
    this.node.send("isActive", false);
    this.end(isOver, time);
  }

  /** The pointer has moved while its button is down. */
  abstract drag(ray: Ray): void;

  protected abstract begin(at: PointedAt, ray: Ray): void;

  protected abstract end(isOver: boolean, time: number): void;
}

class TouchSensor extends PointingSensor {
  override readonly isDragged = false;

  override over(at: PointedAt | undefined): void {
    super.over(at);
    if (at === undefined) return;
    this.node.send("hitPoint_changed", at.point);
    if (at.normal) this.node.send("hitNormal_changed", at.normal);
  }

  override drag(): void {
    // does not follow the pointer
  }

  protected override begin(): void {
    // only the end of a touch has a meaning
  }

  protected override end(isOver: boolean, time: number): void {
    if (isOver) this.node.send("touchTime", time);
  }
}

/** A sensor that makes a value of where the pointer is dragged. */
abstract class DragSensor<Tracked extends readonly number[] | number> extends PointingSensor {
  #last: Tracked | undefined;

  protected abstract readonly output: string;

  /** The value that `offset` becomes with `autoOffset`. */
  protected abstract offsetOf(value: Tracked): readonly number[] | number;

  protected track(point: Point, value: Tracked, sent: readonly number[]): void {
    this.#last = value;
    this.node.send("trackPoint_changed", point);
    this.node.send(this.output, sent);
  }

  protected override end(): void {
    if (this.node.isTrue("autoOffset") && this.#last !== undefined) this.node.send("offset", this.offsetOf(this.#last));
    this.#last = undefined;
  }
}

function axisRotationOf(node: EventNode): Quaternion {
  const [x = 0, y = 0, z = 1, angle = 0] = node.numbersOf("axisRotation");
  return quaternionOf(x, y, z, angle);
}

function turnedRay({ origin, direction }: Ray, rotation: Quaternion): Ray {
  return { origin: turned(origin, rotation), direction: turned(direction, rotation) };
}

/** A limit counts where the minimum is not above the maximum. */
function clamped(value: number, min: number, max: number): number {
  return min > max ? value : Math.max(min, Math.min(max, value));
}

/** Moves in the plane through the point that was pressed, across the z axis after `axisRotation`. */
class PlaneSensor extends DragSensor<readonly number[]> {
  protected override readonly output = "translation_changed";
  #axes: Quaternion = [0, 0, 0, 1];
  #start: Point = [0, 0, 0];
  #offset: Point = [0, 0, 0];

  protected override begin({ point }: PointedAt, ray: Ray): void {
    this.#axes = axisRotationOf(this.node);
    this.#start = turned(point, conjugate(this.#axes));
    this.#offset = turned(this.node.numbersOf("offset"), conjugate(this.#axes));
    this.drag(ray);
  }

  override drag(ray: Ray): void {
    const point = onPlane(turnedRay(ray, conjugate(this.#axes)), 2, this.#start[2]);
    if (point === undefined) return;
    const [minX = 0, minY = 0] = this.node.numbersOf("minPosition");
    const [maxX = -1, maxY = -1] = this.node.numbersOf("maxPosition");
    const x = clamped(point[0] - this.#start[0] + this.#offset[0], minX, maxX);
    const y = clamped(point[1] - this.#start[1] + this.#offset[1], minY, maxY);
    const translation = turned([x, y, this.#offset[2]], this.#axes);
    this.track(turned(point, this.#axes), translation, translation);
  }

  protected override offsetOf(value: readonly number[]): readonly number[] {
    return value;
  }
}

/** Turns about the origin, as a sphere whose surface follows the pointer. */
class SphereSensor extends DragSensor<readonly number[]> {
  protected override readonly output = "rotation_changed";
  #start: Point = [0, 0, 1];
  #offset: Quaternion = [0, 0, 0, 1];

  protected override begin({ point }: PointedAt, ray: Ray): void {
    const [x = 0, y = 1, z = 0, angle = 0] = this.node.numbersOf("offset");
    this.#start = point;
    this.#offset = quaternionOf(x, y, z, angle);
    this.drag(ray);
  }

  override drag(ray: Ray): void {
    const point = onSphere(ray, Math.hypot(...this.#start));
    const rotation = rotationOf(multiply(rotationBetween(this.#start, point), this.#offset));
    this.track(point, rotation, rotation);
  }

  protected override offsetOf(value: readonly number[]): readonly number[] {
    return value;
  }
}

/** Turns about the y axis after `axisRotation`: as a cylinder, or as a disk where the viewer looks along the axis. */
class CylinderSensor extends DragSensor<number> {
  protected override readonly output = "rotation_changed";
  #axes: Quaternion = [0, 0, 0, 1];
  #start: Point = [0, 0, 1];
  #isDisk = false;
  /** Angle of the drag so far, in radians, of any number of turns. */
  #angle = 0;
  #offset = 0;

  protected override begin({ point }: PointedAt, ray: Ray): void {
    this.#axes = axisRotationOf(this.node);
    this.#start = turned(point, conjugate(this.#axes));
    this.#offset = this.node.numberOf("offset");
    this.#angle = 0;
    const { direction } = turnedRay(ray, conjugate(this.#axes));
    const angleToAxis = Math.acos(Math.min(1, Math.abs(direction[1]) / Math.hypot(...direction)));
    this.#isDisk = angleToAxis < this.node.numberOf("diskAngle");
    this.drag(ray);
  }

  override drag(ray: Ray): void {
    const local = turnedRay(ray, conjugate(this.#axes));
    const [x, y, z] = this.#start;
    const point = this.#isDisk ? onPlane(local, 1, y) : onCylinder(local, Math.hypot(x, z));
    if (point === undefined) return;
    const angle = Math.atan2(point[0], point[2]) - Math.atan2(x, z);
    const turn = (angle - this.#angle) / (2 * Math.PI);
    this.#angle = angle - 2 * Math.PI * Math.round(turn);
    const value = clamped(this.#angle + this.#offset, this.node.numberOf("minAngle"), this.node.numberOf("maxAngle"));
    this.track(turned(point, this.#axes), value, [...turned([0, 1, 0], this.#axes), value]);
  }

  protected override offsetOf(value: number): number {
    return value;
  }
}

const common: Readonly<Record<string, FieldSpecification>> = {
  description: inputOutput("SFString", ""),
  enabled: inputOutput("SFBool", true),
  isActive: outputOnly("SFBool", false),
  isOver: outputOnly("SFBool", false),
};

const drag: Readonly<Record<string, FieldSpecification>> = {
  ...common,
  autoOffset: inputOutput("SFBool", true),
  trackPoint_changed: outputOnly("SFVec3f"),
};

export const pointingSensors = {
  CylinderSensor: nodeType(
    {
      ...drag,
      axisRotation: inputOutput("SFRotation", [0, 0, 1, 0]),
      diskAngle: inputOutput("SFFloat", Math.PI / 12),
      minAngle: inputOutput("SFFloat", 0),
      maxAngle: inputOutput("SFFloat", -1),
      offset: inputOutput("SFFloat", 0),
      rotation_changed: outputOnly("SFRotation"),
    },
    (node) => new CylinderSensor(node),
  ),
  PlaneSensor: nodeType(
    {
      ...drag,
      axisRotation: inputOutput("SFRotation", [0, 0, 1, 0]),
      minPosition: inputOutput("SFVec2f", [0, 0]),
      maxPosition: inputOutput("SFVec2f", [-1, -1]),
      offset: inputOutput("SFVec3f", [0, 0, 0]),
      translation_changed: outputOnly("SFVec3f"),
    },
    (node) => new PlaneSensor(node),
  ),
  SphereSensor: nodeType(
    {
      ...drag,
      offset: inputOutput("SFRotation", [0, 1, 0, 0]),
      rotation_changed: outputOnly("SFRotation"),
    },
    (node) => new SphereSensor(node),
  ),
  TouchSensor: nodeType(
    {
      ...common,
      hitNormal_changed: outputOnly("SFVec3f"),
      hitPoint_changed: outputOnly("SFVec3f"),
      touchTime: outputOnly("SFTime"),
    },
    (node) => new TouchSensor(node),
  ),
} as const satisfies Readonly<Record<string, NodeType>>;
