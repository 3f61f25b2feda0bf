// Which nodes of a kind can be bound (ISO/IEC 19775-1, 7.2.2). Those of an inlined document can be bound
// only if the documents around it have none; so an embedded scene looks as it does in its own page.

/** The nodes with the fewest Inlines around them, in the given order. */
export function bindableOf<Node extends { readonly inlineDepth: number }>(nodes: readonly Node[]): readonly Node[] {
  const depth = nodes.reduce((minDepth, { inlineDepth }) => Math.min(minDepth, inlineDepth), Infinity);
  return nodes.every(({ inlineDepth }) => inlineDepth === depth)
    ? nodes
    : nodes.filter(({ inlineDepth }) => inlineDepth === depth);
}
