// The error of a job that a worker cannot run.

/** Thrown in a worker that lacks what the page's thread has: the job is to be run there. */
export class PageThreadNeeded extends Error {
  override readonly name = "PageThreadNeeded";
}
