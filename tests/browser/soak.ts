// Tests that only `make soak` runs, because `make test` has too little time for them.

import { test, type TestContext } from "node:test";

/** Whether this run is a part of `make soak`. */
export const isSoak = process.env.IMGEO_SOAK !== undefined;

/** As `test` in `make soak`; elsewhere there is no such test. */
export const soakTest: (name: string, body: (context: TestContext) => Promise<void> | void) => void = isSoak
  ? (name, body) => void test(name, body)
  : () => undefined;
