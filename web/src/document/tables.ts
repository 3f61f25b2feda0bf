// Lookups in tables by names that documents state.

/** The entry of a name; undefined where the table has none. Every object also has inherited names, as "constructor". */
export function entryOf<Value>(table: Readonly<Record<string, Value>>, name: string): Value | undefined {
  return Object.hasOwn(table, name) ? table[name] : undefined;
}
