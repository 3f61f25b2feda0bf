// A poster stands before the picture until there is one to show, or until the
// page dismisses it.

import type { UserInterface } from "./userInterface.ts";

export type Reveal = "auto" | "manual";

export class Poster {
  reveal: Reveal = "auto";
  readonly #host: Element;
  readonly #face: Pick<UserInterface, "poster" | "posterImage" | "canvas">;
  readonly #send: (event: "poster-dismissed" | "model-visibility", detail: object) => void;
  #hasPicture = false;
  /** What the page has heard of it. */
  #toldVisible = false;

  /** `host` is where a page's own poster would be slotted. */
  constructor(
    host: Element,
    face: Pick<UserInterface, "poster" | "posterImage" | "canvas">,
    send: (event: "poster-dismissed" | "model-visibility", detail: object) => void,
  ) {
    this.#host = host;
    this.#face = face;
    this.#send = send;
  }

  /** Shows the image at `url`, or what the page has slotted; nothing where there is neither, or a picture already. */
  show(url: string, alt: string): void {
    const hasOwn = Array.from(this.#host.children).some((child) => child.slot === "poster");
    if (url !== "") this.#face.posterImage.src = url;
    this.#face.posterImage.hidden = url === "";
    this.#face.posterImage.alt = alt;
    const { poster } = this.#face;
    poster.classList.remove("leaving");
    poster.hidden = this.reveal === "auto" && (this.#hasPicture || (url === "" && !hasOwn));
    this.#face.canvas.inert = this.#isCovering;
    this.#tell();
  }

  /** The first picture is on the screen. */
  onPicture(): void {
    this.#hasPicture = true;
    if (this.reveal === "auto") this.dismiss();
    this.#tell();
  }

  /** With nothing to show yet, the poster goes all the same. */
  dismiss(): void {
    if (!this.#isCovering) return;
    const { poster, canvas } = this.#face;
    poster.classList.add("leaving");
    canvas.inert = false;
    // Without a transition there is no end of one.
    if (
      getComputedStyle(poster)
        .transitionDuration.split(",")
        .every((time) => parseFloat(time) === 0)
    )
      poster.hidden = true;
    else
      poster.addEventListener(
        "transitionend",
        () => {
          poster.hidden = poster.classList.contains("leaving");
        },
        { once: true },
      );
    this.#send("poster-dismissed", {});
    this.#tell();
  }

  get #isCovering(): boolean {
    return !this.#face.poster.hidden && !this.#face.poster.classList.contains("leaving");
  }

  /** There is a picture, and nothing before it. */
  get isModelVisible(): boolean {
    return this.#hasPicture && !this.#isCovering;
  }

  #tell(): void {
    const visible = this.isModelVisible;
    if (visible === this.#toldVisible) return;
    this.#toldVisible = visible;
    this.#send("model-visibility", { visible });
  }
}
