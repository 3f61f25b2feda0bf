// The times of changes of a document on the page's main thread.

import type { Page } from "playwright-core";

/** Self-contained. MutationObservers run before continuations of promises that resolve after the change. */
async function timesIn(change: (round: number) => void, count: number, pause: number): Promise<number[]> {
  const times: number[] = [];
  for (let round = 0; round < count; ++round) {
    await new Promise((resolve) => {
      setTimeout(resolve, pause);
    });
    const begun = performance.now();
    change(round);
    await Promise.resolve();
    times.push(performance.now() - begun);
  }
  return times;
}

/**
 * Makes a change `count` times, `pause` milliseconds apart; resolves with the milliseconds until everything but the
 * picture has followed each. `change` is self-contained and gets the number of the round.
 */
export function changeTimes(
  page: Page,
  change: (round: number) => void,
  count: number,
  pause: number,
): Promise<number[]> {
  return page.evaluate<number[]>(`(${timesIn.toString()})(${change.toString()}, ${count}, ${pause})`);
}
