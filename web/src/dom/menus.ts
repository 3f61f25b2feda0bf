// Menus of a scene: its viewpoints, if several have a description, and its
// navigation types, if NavigationInfo names several. They are native <select>
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
  readonly #cameraController: CameraController;
  readonly #viewpointMenu = makeMenu("Viewpoint");
  readonly #typeMenu = makeMenu("Way to move");
  #namedViewpoints: readonly ViewpointInstance[] = [];
  #listedTypes: readonly NavigationType[] = [];

  constructor(controls: HTMLElement, cameraController: CameraController, signal: AbortSignal) {
    this.#cameraController = cameraController;
    controls.prepend(this.#typeMenu, this.#viewpointMenu);
    this.#viewpointMenu.addEventListener(
      "change",
      () => {
        const chosen = this.#namedViewpoints[this.#viewpointMenu.selectedIndex];
        if (chosen) cameraController.bind(chosen.element);
      },
      { signal },
    );
    this.#typeMenu.addEventListener(
      "change",
      () => {
        cameraController.type = this.#listedTypes[this.#typeMenu.selectedIndex] ?? cameraController.type;
      },
      { signal },
    );
  }

  /** Updates the menus from the camera controller. */
  update(): void {
    const { namedViewpoints, listedTypes, bound, type } = this.#cameraController;
    this.#namedViewpoints = namedViewpoints;
    this.#listedTypes = listedTypes;
    fillMenu(
      this.#viewpointMenu,
      this.#namedViewpoints.map(({ viewpoint }) => viewpoint.description),
      this.#namedViewpoints.findIndex(({ element }) => element === bound),
    );
    fillMenu(
      this.#typeMenu,
      this.#listedTypes.map((listed) => typeNames[listed]),
      this.#listedTypes.indexOf(type),
    );
  }
}

function makeMenu(label: string): HTMLSelectElement {
  const menu = document.createElement("select");
  menu.setAttribute("aria-label", label);
  menu.setAttribute("part", label === "Viewpoint" ? "viewpoints" : "navigation-types");
  menu.hidden = true;
  return menu;
}

/**
 * Sets a menu's options, and hides a menu with fewer than two. Replaces options only if they differ, so that an open
 * menu stays open.
 */
function fillMenu(menu: HTMLSelectElement, names: readonly string[], selected: number): void {
  const isSame =
    names.length === menu.options.length && names.every((name, index) => menu.options[index]?.text === name);
  if (!isSame) menu.replaceChildren(...names.map((name) => new Option(name)));
  menu.hidden = names.length < 2;
  if (menu.selectedIndex !== selected) menu.selectedIndex = selected;
}
