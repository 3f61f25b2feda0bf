// Runs in a page: a path around a relief, from afar to its surface and back.

export interface Flight {
  /** Milliseconds between frames that were drawn. */
  frameTimes: number[];
  /** The most WebGL bytes after a frame, as counted from the page's calls. */
  maxGpuBytes: number;
  /** The largest error in pixels that was drawn at the end of each second. */
  errors: number[];
  maxOpenRequests: number;
}

/**
 * Self-contained: its text is sent to the browser. Flies once around in `seconds`, and twice from a distance of 3 to 1.25
 * and back. `countGpuBytes` counts.
 */
export async function fly(seconds: number): Promise<Flight> {
  const x3d = document.querySelector("x3d") as unknown as {
    statistics: { frames: number; openRequests: number; levels: { errorInPixels: number } };
  };
  const viewpoint = document.querySelector("viewpoint")!;
  const flight: Flight = { frameTimes: [], maxGpuBytes: 0, errors: [], maxOpenRequests: 0 };
  const begin = performance.now();
  let before = begin;
  let nextSample = begin + 1000;
  for (let now = begin; now < begin + 1000 * seconds;) {
    const part = (now - begin) / (1000 * seconds);
    const [around, up] = [2 * Math.PI * part, 0.5 * Math.sin(4 * Math.PI * part)];
    const distance = 2.125 + 0.875 * Math.cos(4 * Math.PI * part);
    const position = [Math.sin(around) * Math.cos(up), Math.sin(up), Math.cos(around) * Math.cos(up)];
    // The turn by `around` about y after that by -`up` about x, as a quaternion.
    const [c, s] = [Math.cos(around / 2), Math.sin(around / 2)];
    const [d, t] = [Math.cos(up / 2), -Math.sin(up / 2)];
    const [w, x, y, z] = [c * d, c * t, s * d, -s * t];
    const sine = Math.hypot(x, y, z);
    const axis = sine > 1e-9 ? [x / sine, y / sine, z / sine] : [0, 1, 0];
    viewpoint.setAttribute("position", position.map((value) => (distance * value).toFixed(5)).join(" "));
    viewpoint.setAttribute(
      "orientation",
      [...axis, 2 * Math.atan2(sine, w)].map((value) => value.toFixed(6)).join(" "),
    );
    await new Promise(requestAnimationFrame);
    now = performance.now();
    flight.frameTimes.push(now - before);
    before = now;
    flight.maxGpuBytes = Math.max(flight.maxGpuBytes, (window as unknown as { gpuBytes: number }).gpuBytes);
    if (now < nextSample) continue;
    nextSample = now + 1000;
    const { openRequests, levels } = x3d.statistics;
    flight.errors.push(levels.errorInPixels);
    flight.maxOpenRequests = Math.max(flight.maxOpenRequests, openRequests);
  }
  return flight;
}
