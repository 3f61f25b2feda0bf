// The poster of a view: covers the canvas until the scene has a picture, or until the
// page dismisses it.

import type { UserInterface } from "./userInterface.ts";

export type Reveal = "auto" | "manual";

export class Poster {
  reveal: Reveal = "auto";
  readonly #host: Element;
  readonly #ui: Pick<UserInterface, "poster" | "posterImage" | "canvas">;
  readonly #send: (event: "poster-dismissed" | "model-visibility", detail: object) => void;
  #hasPicture = false;
  /** The value in the last `model-visibility` event. */
  #sentVisible = false;

  /** `host`: the element into which a page slots its own poster. */
  constructor(
    host: Element,
    ui: Pick<UserInterface, "poster" | "posterImage" | "canvas">,
    send: (event: "poster-dismissed" | "model-visibility", detail: object) => void,
  ) {
    this.#host = host;
    this.#ui = ui;
    this.#send = send;
  }

  /**
   * Shows the image at `url`, or the page's slotted poster. Shows nothing if there is neither, or if the scene already
   * has a picture and `reveal` is "auto".
   */
  show(url: string, alt: string): void {
    const hasSlottedPoster = Array.from(this.#host.children).some((child) => child.slot === "poster");
    if (url !== "") this.#ui.posterImage.src = url;
    this.#ui.posterImage.hidden = url === "";
    this.#ui.posterImage.alt = alt;
    const { poster } = this.#ui;
    poster.classList.remove("leaving");
    poster.hidden = this.reveal === "auto" && (this.#hasPicture || (url === "" && !hasSlottedPoster));
    this.#ui.canvas.inert = this.#isCovering;
    this.#sendVisibility();
  }

  /** The canvas displays its first picture. */
  onPicture(): void {
    this.#hasPicture = true;
    if (this.reveal === "auto") this.dismiss();
    this.#sendVisibility();
  }

  /** Removes the poster, even before there is a picture. */
  dismiss(): void {
    if (!this.#isCovering) return;
    const { poster, canvas } = this.#ui;
    poster.classList.add("leaving");
    canvas.inert = false;
    // Without a transition there is no `transitionend`.
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
    this.#sendVisibility();
  }

  get #isCovering(): boolean {
    return !this.#ui.poster.hidden && !this.#ui.poster.classList.contains("leaving");
  }

  /** Whether there is a picture, and no poster in front of it. */
  get isModelVisible(): boolean {
    return this.#hasPicture && !this.#isCovering;
  }

  #sendVisibility(): void {
    const visible = this.isModelVisible;
    if (visible === this.#sentVisible) return;
    this.#sentVisible = visible;
    this.#send("model-visibility", { visible });
  }
}
