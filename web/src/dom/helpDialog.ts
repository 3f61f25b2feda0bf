// The dialog that lists gestures and keys of the navigation type in use.

import type { NavigationType } from "../navigation/navigationType.ts";
import { closeLabel, gestureRows, helpTitles } from "./labels.ts";

export class HelpDialog {
  readonly #dialog: HTMLDialogElement;

  constructor(dialog: HTMLDialogElement) {
    this.#dialog = dialog;
  }

  /**
   * Opens the dialog; its focus returns to where it was when it is closed, by Escape, its button or a click beside it.
   */
  open(type: NavigationType): void {
    if (this.#dialog.open) return;
    const table = document.createElement("table");
    for (const [input, effect] of gestureRows(type)) {
      const row = table.insertRow();
      const head = document.createElement("th");
      head.scope = "row";
      head.textContent = input;
      row.append(head);
      row.insertCell().textContent = effect;
    }
    const title = document.createElement("h2");
    title.textContent = helpTitles[type];
    title.id = "help-title";
    const close = document.createElement("button");
    close.type = "button";
    close.textContent = closeLabel;
    close.autofocus = true;
    this.#dialog.setAttribute("aria-labelledby", title.id);
    this.#dialog.replaceChildren(title, table, close);
    this.#dialog.onclick = ({ target }) => {
      if (target === this.#dialog || target === close) this.#dialog.close();
    };
    this.#dialog.showModal();
  }
}
