// X3D's binding stack (ISO/IEC 19775-1, 7.2.2): the node on top is bound; when it is removed, the node below is
// bound again.

export class BindingStack<Node> {
  /** The bound node is last. */
  #stack: Node[] = [];
  #nodes: readonly Node[] = [];

  /** Undefined where there are no nodes. */
  get bound(): Node | undefined {
    return this.#stack.at(-1);
  }

  /** set_bind TRUE. */
  bind(node: Node): void {
    this.#stack = [...this.#stack.filter((other) => other !== node), node];
  }

  /** set_bind FALSE. The first node is bound where the stack would be empty. */
  unbind(node: Node): void {
    this.#stack = this.#stack.filter((other) => other !== node);
    const first = this.#nodes.find((other) => other !== node) ?? this.#nodes[0];
    if (this.#stack.length === 0 && first !== undefined) this.#stack.push(first);
  }

  /** Sets the scene's nodes, and binds new ones that request it. */
  follow(nodes: readonly { readonly element: Node; readonly isBindRequested: boolean }[]): void {
    const requested = new Set(nodes.filter(({ isBindRequested }) => isBindRequested).map(({ element }) => element));
    this.setNodes(
      nodes.map(({ element }) => element),
      (element) => requested.has(element),
    );
  }

  /**
   * Sets the scene's nodes, in document order. Removed nodes leave the stack; new nodes that request to be bound go on
   * top.
   */
  setNodes(nodes: readonly Node[], isBindRequested: (node: Node) => boolean): void {
    const added = nodes.filter((node) => !this.#nodes.includes(node));
    this.#nodes = nodes;
    this.#stack = this.#stack.filter((node) => nodes.includes(node));
    for (const node of added) if (isBindRequested(node)) this.bind(node);
    if (this.#stack.length === 0 && nodes[0] !== undefined) this.#stack.push(nodes[0]);
  }
}
