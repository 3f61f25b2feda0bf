// Runs in the page before its scripts and records events of the scene, WebGL calls and live WebGL objects. It
// intercepts them from outside the runtime, so that tests do not depend on the runtime's own statistics.

export interface ObservedEvent {
  type: string;
  /** "x3d", or "shape" with "#id" where it has one. */
  target: string;
  bubbles: boolean;
  detail: Record<string, unknown>;
  /** Milliseconds since navigation. */
  at: number;
}

export interface Observed {
  /** Events of <x3d> and <shape> elements, in order. */
  events: ObservedEvent[];
  /** Types of such events that bubbled up to the document: must be empty. */
  bubbled: string[];
  /** Number of draw calls and clears so far; constant while nothing is rendered. */
  draws: number;
  /** Numbers of live WebGL objects and of open decoded images. */
  live: { textures: number; buffers: number; vertexArrays: number; programs: number; bitmaps: number };
}

declare global {
  interface Window {
    observed: Observed;
  }
}

/** Self-contained: its text is sent to the browser. */
export function observe(): void {
  const observed: Observed = {
    events: [],
    bubbled: [],
    draws: 0,
    live: { textures: 0, buffers: 0, vertexArrays: 0, programs: 0, bitmaps: 0 },
  };
  window.observed = observed;

  const isOurs = (target: EventTarget | null): target is Element =>
    target instanceof Element && /^(x3d|shape)$/i.test(target.localName);
  for (const type of ["progress", "first-image", "refine", "load", "error"]) {
    document.addEventListener(type, (event) => {
      if (isOurs(event.target)) observed.bubbled.push(type);
    });
    const record = (event: Event): void => {
      if (!isOurs(event.target)) return;
      const detail: Record<string, unknown> = {};
      for (const [key, value] of Object.entries(((event as CustomEvent).detail ?? {}) as object)) {
        detail[key] = value instanceof Element ? value.localName.toLowerCase() : (value as unknown);
      }
      const id = event.target.id === "" ? "" : `#${event.target.id}`;
      observed.events.push({
        type,
        target: event.target.localName.toLowerCase() + id,
        bubbles: event.bubbles,
        detail,
        at: performance.now(),
      });
    };
    // Events that do not bubble still pass the document in the capture phase.
    document.addEventListener(type, record, true);
  }

  const gl = WebGL2RenderingContext.prototype as unknown as Record<string, (...args: unknown[]) => unknown>;
  const after = (name: string, note: (args: unknown[]) => void): void => {
    const original = gl[name];
    if (original === undefined) throw new Error(`WebGL2 has no ${name}`);
    gl[name] = function (...args) {
      note(args);
      return original.apply(this, args);
    };
  };
  for (const name of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced", "clear"]) {
    after(name, () => ++observed.draws);
  }
  const kinds = { Texture: "textures", Buffer: "buffers", VertexArray: "vertexArrays", Program: "programs" } as const;
  for (const [kind, counter] of Object.entries(kinds)) {
    const counted = counter;
    after(`create${kind}`, () => ++observed.live[counted]);
    after(`delete${kind}`, ([object]) => (observed.live[counted] -= object ? 1 : 0));
  }

  const decode = window.createImageBitmap.bind(window) as (...args: unknown[]) => Promise<ImageBitmap>;
  window.createImageBitmap = async (...args: unknown[]) => {
    const bitmap = await decode(...args);
    observed.live.bitmaps += 1;
    return bitmap;
  };
  const close = Object.getOwnPropertyDescriptor(ImageBitmap.prototype, "close")?.value as () => void;
  ImageBitmap.prototype.close = function () {
    if (this.width > 0) observed.live.bitmaps -= 1; // a second time does nothing
    close.call(this);
  };
}
