/** Writes each message to the console once, however many shapes it concerns and however often a document is read. */
export class MessageLog {
  readonly #written = new Set<string>();

  warn(message: string): void {
    this.#write("warn", message);
  }

  error(message: string): void {
    this.#write("error", message);
  }

  #write(level: "warn" | "error", message: string): void {
    if (this.#written.has(message)) return;
    this.#written.add(message);
    console[level](`imgeo: ${message}`);
  }
}
