// Follows the pointer for a document's pointing device sensors. The shapes get pointer events with the point that was
// hit; while a button is down, the window's own events say where the pointer is.

import type { AnimatedElement } from "../elements.ts";
import type { AnimationPlayer } from "../player.ts";
import type { PointedAt } from "../pointingSensors.ts";
import { PointingSensor } from "../pointingSensors.ts";
import type { Point, Ray } from "../rays.ts";
import type { Matrix } from "./matrices.ts";
import { inverseOf, normalBefore, transformDirection, transformPoint } from "./matrices.ts";

export interface PointerSpace {
  /** Gets the pointer events of all shapes, those of inlined documents too. */
  readonly pointerTarget: EventTarget;
  /** The ray of the last frame's camera at a position in the viewport (`clientX`, `clientY`), in scene coordinates. */
  rayAt(x: number, y: number): Ray | undefined;
  /** The transform from the coordinates of an element's children to the scene's. */
  sceneFromChildrenOf(element: AnimatedElement): Matrix;
}

/** A point of a pointer event on a shape. */
interface Vector {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

interface ShapeEvent extends PointerEvent {
  readonly worldPosition?: Vector;
  readonly worldNormal?: Vector | null;
  /** The shape itself; the target is the Inline where it is in another document. */
  readonly shapeElement?: Element;
}

interface SensorAt {
  readonly sensor: PointingSensor;
  readonly element: AnimatedElement;
}

/** CSS pixels that the pointer may move during a touch. A longer way is a drag, which moves the camera. */
const maxTouchMovement = 5;

interface Press {
  readonly pointerId: number;
  readonly x: number;
  readonly y: number;
  readonly sensors: readonly SensorAt[];
  /** Whether the press keeps the camera still. */
  readonly holdsCamera: boolean;
  hasMoved: boolean;
}

export class PointerSensing {
  readonly #roots: () => readonly Element[];
  readonly #player: AnimationPlayer;
  readonly #space: PointerSpace;
  #over: readonly SensorAt[] = [];
  #press: Press | undefined;

  /** Listens until `signal` aborts. `roots`: of the documents. */
  constructor(roots: () => readonly Element[], player: AnimationPlayer, space: PointerSpace, signal: AbortSignal) {
    this.#roots = roots;
    this.#player = player;
    this.#space = space;
    const listen = (type: string, listener: (event: ShapeEvent) => void): void => {
      space.pointerTarget.addEventListener(
        type,
        (event) => {
          listener(event as ShapeEvent);
        },
        { signal },
      );
    };
    listen("pointerdown", (event) => {
      this.#begin(event);
    });
    for (const type of ["pointerover", "pointermove"])
      listen(type, (event) => {
        this.#hover(event);
      });
    listen("pointerout", (event) => {
      const { relatedTarget } = event;
      if (relatedTarget === null || !(space.pointerTarget as Node).contains(relatedTarget as Node)) this.#leave();
    });
    const follow = (type: string, listener: (event: PointerEvent) => void): void => {
      window.addEventListener(
        type,
        (event) => {
          const pointer = event as PointerEvent;
          if (event.isTrusted && pointer.pointerId === this.#press?.pointerId) listener(pointer);
        },
        { signal, capture: true },
      );
    };
    follow("pointermove", (event) => {
      this.#drag(event);
    });
    follow("pointerup", (event) => {
      this.#drag(event);
      this.#end(true);
    });
    follow("pointercancel", () => {
      this.#end(false);
    });
  }

  /** Whether a sensor follows the pointer. */
  get isDragging(): boolean {
    return this.#press !== undefined;
  }

  /** The enabled sensors that sense a shape: those beside it, or its Inline, in the innermost group that has any. */
  #sensorsOf({ target, shapeElement }: ShapeEvent): readonly SensorAt[] {
    // A shape of an inlined document is sensed in that document before the Inline is.
    for (const sensed of new Set([shapeElement, target])) {
      const sensors = sensed instanceof Element ? this.#sensorsAround(sensed) : [];
      if (sensors.length > 0) return sensors;
    }
    return [];
  }

  #sensorsAround(sensed: Element): readonly SensorAt[] {
    const root = this.#roots().find((each) => each.contains(sensed));
    for (let at = root ? sensed : null; at !== null && at !== root; at = at.parentElement) {
      const sensors: SensorAt[] = [];
      for (const element of Array.from(at.children)) {
        const behaviour = this.#player.nodes.get(element)?.behaviour;
        if (behaviour instanceof PointingSensor && behaviour.isEnabled) sensors.push({ sensor: behaviour, element });
      }
      if (sensors.length > 0) return sensors;
    }
    return [];
  }

  #begin(event: ShapeEvent): void {
    if (event.button !== 0 || this.#press !== undefined || !event.worldPosition) return;
    const sensors = this.#sensorsOf(event);
    if (sensors.length === 0) return;
    this.#hover(event);
    const holdsCamera = sensors.some(({ sensor }) => sensor.isDragged);
    this.#press = {
      pointerId: event.pointerId,
      x: event.clientX,
      y: event.clientY,
      sensors,
      holdsCamera,
      hasMoved: false,
    };
    if (holdsCamera) event.preventDefault();
    this.#player.run(() => {
      for (const { sensor, element } of sensors) {
        const at = this.#pointedAt(event, element);
        const ray = this.#localRay(event, element);
        if (at && ray) sensor.press(at, ray);
      }
    });
  }

  #drag({ clientX, clientY }: PointerEvent): void {
    const press = this.#press;
    if (!press) return;
    press.hasMoved ||= Math.hypot(clientX - press.x, clientY - press.y) > maxTouchMovement;
    if (!press.holdsCamera) return;
    this.#player.run(() => {
      for (const { sensor, element } of press.sensors) {
        const ray = this.#localRay({ clientX, clientY }, element);
        if (ray && sensor.isActive) sensor.drag(ray);
      }
    });
  }

  #end(isTouch: boolean): void {
    const press = this.#press;
    if (!press) return;
    this.#press = undefined;
    const isOver = (sensor: PointingSensor): boolean => this.#over.some((over) => over.sensor === sensor);
    this.#player.run((time) => {
      for (const { sensor } of press.sensors)
        if (sensor.isActive) sensor.release(isTouch && isOver(sensor) && (press.holdsCamera || !press.hasMoved), time);
    });
  }

  #hover(event: ShapeEvent): void {
    const sensors = event.worldPosition ? this.#sensorsOf(event) : [];
    if (sensors.length === 0 && this.#over.length === 0) return;
    const left = this.#over.filter(({ sensor }) => !sensors.some((now) => now.sensor === sensor));
    this.#over = sensors;
    this.#player.run(() => {
      for (const { sensor } of left) sensor.over(undefined);
      for (const { sensor, element } of sensors) {
        const at = this.#pointedAt(event, element);
        if (at) sensor.over(at);
      }
    });
  }

  #leave(): void {
    const left = this.#over;
    this.#over = [];
    if (left.length > 0)
      this.#player.run(() => {
        for (const { sensor } of left) sensor.over(undefined);
      });
  }

  #sceneFromSensor(element: AnimatedElement): Matrix {
    return this.#space.sceneFromChildrenOf(element.parentElement ?? element);
  }

  #pointedAt({ worldPosition, worldNormal }: ShapeEvent, element: AnimatedElement): PointedAt | undefined {
    const matrix = this.#sceneFromSensor(element);
    const localFromScene = inverseOf(matrix);
    if (!worldPosition || !localFromScene) return undefined;
    const pointOf = ({ x, y, z }: Vector): Point => [x, y, z];
    return {
      point: transformPoint(localFromScene, pointOf(worldPosition)),
      normal: worldNormal ? normalBefore(matrix, pointOf(worldNormal)) : undefined,
    };
  }

  #localRay(
    { clientX, clientY }: Pick<PointerEvent, "clientX" | "clientY">,
    element: AnimatedElement,
  ): Ray | undefined {
    const localFromScene = inverseOf(this.#sceneFromSensor(element));
    const ray = this.#space.rayAt(clientX, clientY);
    return (
      localFromScene &&
      ray && {
        origin: transformPoint(localFromScene, ray.origin),
        direction: transformDirection(localFromScene, ray.direction),
      }
    );
  }
}
