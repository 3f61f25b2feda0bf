// Trusted Types (https://www.w3.org/TR/trusted-types/): where the policy of a page says
// `require-trusted-types-for 'script'`, the browser refuses plain strings as documents to be parsed and as addresses of
// workers. The runtime marks its own by the policy "imgeo", which such a page allows by `trusted-types imgeo`. What it
// parses stays in documents without a window, so that nothing in them runs.

/** What makes strings trusted. To the functions that take them they are strings. */
interface TrustedTypesPolicy {
  createHTML(text: string): string;
  createScriptURL(url: string): string;
}

interface TrustedTypesFactory {
  createPolicy(name: string, rules: TrustedTypesPolicy): TrustedTypesPolicy;
}

const unchanged: TrustedTypesPolicy = { createHTML: (text) => text, createScriptURL: (url) => url };

let policy: TrustedTypesPolicy | undefined;

/** A page may have one policy of a name, so it is made once. */
function imgeoPolicy(): TrustedTypesPolicy {
  if (policy) return policy;
  const { trustedTypes } = globalThis as { trustedTypes?: TrustedTypesFactory };
  try {
    policy = trustedTypes?.createPolicy("imgeo", unchanged);
  } catch {
    // The page does not allow it. The browser reports that, and refuses strings where it requires trusted ones.
  }
  return (policy ??= unchanged);
}

/** Parses text to a document without a window. */
export function parseDocument(text: string, type: DOMParserSupportedType): Document {
  return new DOMParser().parseFromString(imgeoPolicy().createHTML(text), type);
}

/** Starts a worker that is an ES module. `url`: absolute. */
export function startModuleWorker(url: string): Worker {
  return new Worker(imgeoPolicy().createScriptURL(url), { type: "module", name: "imgeo" });
}
