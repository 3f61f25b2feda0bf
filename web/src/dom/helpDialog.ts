// The dialog that lists gestures and keys of the navigation type in use.

import type { NavigationType } from "../navigation/navigationType.ts";
import { closeLabel, gestureRows, helpTitles } from "./overlayLabels.ts";

/** Opens the dialog. When Escape, its button or a click beside it closes it, the focus returns to where it was. */
export function openHelp(dialog: HTMLDialogElement, type: NavigationType): void {
  if (dialog.open) return;
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
  dialog.setAttribute("aria-labelledby", title.id);
  dialog.replaceChildren(title, table, close);
  dialog.onclick = ({ target }) => {
    if (target === dialog || target === close) dialog.close();
  };
  dialog.showModal();
}
