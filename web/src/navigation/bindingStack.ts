// X3D's binding stack (ISO/IEC 19775-1, 7.2.2): the node on top counts; when it
// is taken away, the one below counts again.

export class BindingStack<Node> {
  /** The one that counts is last. */
  #stack: Node[] = [];
  #nodes: readonly Node[] = [];

  /** Undefined where there are no nodes at all. */
  get bound(): Node | undefined {
    return this.#stack.at(-1);
  }

  /** set_bind TRUE. */
  bind(node: Node): void {
    this.#stack = [...this.#stack.filter((other) => other !== node), node];
  }

  /** set_bind FALSE. The first node counts where no other is left. */
  unbind(node: Node): void {
    this.#stack = this.#stack.filter((other) => other !== node);
    const first = this.#nodes.find((other) => other !== node) ?? this.#nodes[0];
    if (this.#stack.length === 0 && first !== undefined) this.#stack.push(first);
  }

  /**
   * The scene's nodes, in document order, from now on. Those that are gone leave
   * the stack; those that are new and `wantsBind` go on top of it.
   */
  setNodes(nodes: readonly Node[], wantsBind: (node: Node) => boolean): void {
    const added = nodes.filter((node) => !this.#nodes.includes(node));
    this.#nodes = nodes;
    this.#stack = this.#stack.filter((node) => nodes.includes(node));
    for (const node of added) if (wantsBind(node)) this.bind(node);
    if (this.#stack.length === 0 && nodes[0] !== undefined) this.#stack.push(nodes[0]);
  }
}
