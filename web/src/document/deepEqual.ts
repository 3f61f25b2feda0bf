/** Whether two values of plain data are equal. */
export function deepEqual(a: unknown, b: unknown): boolean {
  if (Object.is(a, b)) return true;
  if (typeof a !== "object" || typeof b !== "object" || a === null || b === null) return false;
  const [own, others] = [a as Readonly<Record<string, unknown>>, b as Readonly<Record<string, unknown>>];
  const names = Object.keys(own);
  return (
    names.length === Object.keys(others).length &&
    names.every((name) => name in others && deepEqual(own[name], others[name]))
  );
}
