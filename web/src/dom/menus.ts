// Menus of a scene: its viewpoints, where it has several with a description, and its
// navigation types, where NavigationInfo names several. They are native <select>
// elements, which support keyboard, touch and screen readers.

import type { ViewpointInstance } from "../scene/instances.ts";
import type { NavigationType } from "../navigation/navigationType.ts";
import type { CameraController } from "../navigation/cameraController.ts";

const typeNames: Readonly<Record<NavigationType, string>> = {
  examine: "Examine",
  walk: "Walk",
  fly: "Fly",
  none: "Stay",
};

export class Menus {
  readonly #navigator: CameraController;
  readonly #viewpoints = listOf("Viewpoint");
  readonly #types = listOf("Way to move");
  #named: readonly ViewpointInstance[] = [];
  #listedTypes: readonly NavigationType[] = [];

  constructor(controls: HTMLElement, navigator: CameraController, signal: AbortSignal) {
    this.#navigator = navigator;
    controls.replaceChildren(this.#types, this.#viewpoints);
    this.#viewpoints.addEventListener(
      "change",
      () => {
        const chosen = this.#named[this.#viewpoints.selectedIndex];
        if (chosen) navigator.bind(chosen.element);
      },
      { signal },
    );
    this.#types.addEventListener(
      "change",
      () => {
        navigator.type = this.#listedTypes[this.#types.selectedIndex] ?? navigator.type;
      },
      { signal },
    );
  }

  /** Updates the menus from the navigator. */
  update(): void {
    const { viewpoints, bound, type } = this.#navigator;
    this.#named = viewpoints.filter(({ viewpoint }) => viewpoint.description !== "");
    this.#listedTypes = this.#navigator.listedTypes;
    fill(
      this.#viewpoints,
      this.#named.map(({ viewpoint }) => viewpoint.description),
      this.#named.findIndex(({ element }) => element === bound),
    );
    fill(
      this.#types,
      this.#listedTypes.map((listed) => typeNames[listed]),
      this.#listedTypes.indexOf(type),
    );
  }
}

function listOf(label: string): HTMLSelectElement {
  const list = document.createElement("select");
  list.setAttribute("aria-label", label);
  list.setAttribute("part", label === "Viewpoint" ? "viewpoints" : "navigation-types");
  list.hidden = true;
  return list;
}

/** Hides a menu of fewer than two options. Options are replaced only where they differ, so that an open menu stays open. */
function fill(list: HTMLSelectElement, names: readonly string[], selected: number): void {
  const isSame =
    names.length === list.options.length && names.every((name, index) => list.options[index]?.text === name);
  if (!isSame) list.replaceChildren(...names.map((name) => new Option(name)));
  list.hidden = names.length < 2;
  if (list.selectedIndex !== selected) list.selectedIndex = selected;
}
