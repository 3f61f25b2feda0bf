// Whether workers may compile WebAssembly, found out without trying: where a policy forbids it, the attempt would be
// reported to the site's owner.

/** Whether all policies of a Content-Security-Policy header allow WebAssembly; null: there is no header. */
export function policyAllowsWasm(header: string | null): boolean {
  return (header ?? "").split(",").every((policy) => {
    const directives = new Map<string, readonly string[]>();
    for (const directive of policy.toLowerCase().split(";")) {
      const [name = "", ...sources] = directive.trim().split(/\s+/);
      if (!directives.has(name)) directives.set(name, sources); // the first of equal directives counts
    }
    const sources = directives.get("script-src") ?? directives.get("default-src");
    return sources === undefined || sources.includes("'wasm-unsafe-eval'") || sources.includes("'unsafe-eval'");
  });
}

/**
 * Whether the workers that run this file may compile WebAssembly. A worker obeys the policy of its file, not that of
 * the page; the answer usually comes from the browser's cache. Rejects if the file cannot be requested.
 */
export async function workersAllowWasm(workerUrl: URL): Promise<boolean> {
  // A worker of a blob or a data URL obeys the policy of whatever started it, which cannot be read.
  if (!/^https?:$/.test(workerUrl.protocol)) return false;
  const { ok, headers } = await fetch(workerUrl, { method: "HEAD", cache: "force-cache", priority: "low" });
  const names = ["content-security-policy", "content-security-policy-report-only"];
  return ok && names.every((name) => policyAllowsWasm(headers.get(name)));
}
