/** Different messages that are written; memory stays bounded in pages whose documents change for days. */
export const maxMessages = 1000;

/**
 * Writes each message to the console once, however many shapes it concerns and however often a document is read. After
 * `maxMessages` different ones a last message says that further ones are not written.
 */
export class MessageLog {
  readonly #written = new Set<string>();

  warn(message: string): void {
    this.#write("warn", message);
  }

  error(message: string): void {
    this.#write("error", message);
  }

  #write(level: "warn" | "error", message: string): void {
    if (this.#written.size > maxMessages || this.#written.has(message)) return;
    this.#written.add(message);
    if (this.#written.size > maxMessages) console.warn(`imgeo: further messages are not written`);
    else console[level](`imgeo: ${message}`);
  }
}
