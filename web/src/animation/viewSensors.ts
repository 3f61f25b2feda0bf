// X3D's sensors of the viewer (ISO/IEC 19775-1, clause 22): ProximitySensor and VisibilitySensor.

import type { Behaviour, EventNode, FieldSpecification } from "./eventNode.ts";
import type { NodeType } from "./nodeType.ts";
import { inputOutput, nodeType, outputOnly } from "./nodeType.ts";
import type { Quaternion } from "./rotations.ts";
import { rotationOf } from "./rotations.ts";

/** The viewer, in a sensor's coordinates. Matrices are column by column. */
export interface LocalView {
  readonly position: readonly [x: number, y: number, z: number];
  readonly orientation: Quaternion;
  /** The point about which the viewer turns. */
  readonly centerOfRotation: readonly [x: number, y: number, z: number];
  readonly clipFromLocal: ArrayLike<number>;
}

export abstract class ViewSensor implements Behaviour {
  protected readonly node: EventNode;

  constructor(node: EventNode) {
    this.node = node;
  }

  receive(): void {
    // the next frame's view decides
  }

  /** Sends what the view of a frame changes. `time` in seconds. */
  follow(view: LocalView, time: number): void {
    const isActive = this.node.isTrue("enabled") && this.hasVolume && this.perceives(view);
    if (isActive !== this.node.isTrue("isActive")) {
      this.node.send("isActive", isActive);
      this.node.send(isActive ? "enterTime" : "exitTime", time);
    }
    if (isActive) this.sendView(view);
  }

  protected get center(): readonly number[] {
    return this.node.numbersOf("center");
  }

  protected get size(): readonly number[] {
    return this.node.numbersOf("size");
  }

  /** A sensor with a size of 0 never becomes active. */
  protected get hasVolume(): boolean {
    return this.size.every((extent) => extent > 0);
  }

  protected abstract perceives(view: LocalView): boolean;

  protected abstract sendView(view: LocalView): void;
}

class ProximitySensor extends ViewSensor {
  protected override perceives({ position }: LocalView): boolean {
    return position.every(
      (coordinate, axis) => Math.abs(coordinate - (this.center[axis] ?? 0)) <= (this.size[axis] ?? 0) / 2,
    );
  }

  protected override sendView({ position, orientation, centerOfRotation }: LocalView): void {
    this.#sendChanged("position_changed", position);
    this.#sendChanged("orientation_changed", rotationOf(orientation));
    this.#sendChanged("centerOfRotation_changed", centerOfRotation);
  }

  #sendChanged(field: string, value: readonly number[]): void {
    const before = this.node.valueOf(field) as readonly number[] | undefined;
    if (before === undefined || value.some((number, i) => number !== before[i])) this.node.send(field, value);
  }
}

class VisibilitySensor extends ViewSensor {
  /**
   * Whether a part of the box may be in the view: not all its corners are beyond one side of it, or behind the viewer.
   * The depths that pages draw are those of the shapes, and do not count.
   */
  protected override perceives({ clipFromLocal: m }: LocalView): boolean {
    const isParallel = m[3] === 0 && m[7] === 0 && m[11] === 0;
    const beyond = [0, 0, 0, 0, 0];
    for (let corner = 0; corner < 8; corner++) {
      const [x = 0, y = 0, z = 0] = this.center.map(
        (middle, axis) => middle + (((corner >> axis) & 1) - 0.5) * (this.size[axis] ?? 0),
      );
      const row = (r: number): number => (m[r] ?? 0) * x + (m[r + 4] ?? 0) * y + (m[r + 8] ?? 0) * z + (m[r + 12] ?? 0);
      const w = row(3);
      const sides = [row(0) > w, row(0) < -w, row(1) > w, row(1) < -w, isParallel ? row(2) < -w : w <= 0];
      sides.forEach((isBeyond, side) => {
        if (isBeyond) beyond[side] = (beyond[side] ?? 0) + 1;
      });
    }
    return beyond.every((count) => count < 8);
  }

  protected override sendView(): void {
    // its events are those of every sensor
  }
}

const common: Readonly<Record<string, FieldSpecification>> = {
  center: inputOutput("SFVec3f", [0, 0, 0]),
  enabled: inputOutput("SFBool", true),
  size: inputOutput("SFVec3f", [0, 0, 0]),
  enterTime: outputOnly("SFTime"),
  exitTime: outputOnly("SFTime"),
  isActive: outputOnly("SFBool", false),
};

export const viewSensors = {
  ProximitySensor: nodeType(
    {
      ...common,
      centerOfRotation_changed: outputOnly("SFVec3f"),
      orientation_changed: outputOnly("SFRotation"),
      position_changed: outputOnly("SFVec3f"),
    },
    (node) => new ProximitySensor(node),
  ),
  VisibilitySensor: nodeType(common, (node) => new VisibilitySensor(node)),
} as const satisfies Readonly<Record<string, NodeType>>;
