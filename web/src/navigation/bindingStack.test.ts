import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { BindingStack } from "./bindingStack.ts";

describe("the binding stack", () => {
  const stackOf = (nodes: string[], bindRequested: string[] = []) => {
    const stack = new BindingStack<string>();
    stack.setNodes(nodes, (node) => bindRequested.includes(node));
    return stack;
  };

  test("binds the first node, or the last one that requests to be bound", () => {
    assert.equal(stackOf([]).bound, undefined);
    assert.equal(stackOf(["a", "b", "c"]).bound, "a");
    assert.equal(stackOf(["a", "b", "c"], ["c", "b"]).bound, "c");
  });

  test("binds the node below when the top is unbound or removed from the scene", () => {
    const stack = stackOf(["a", "b", "c"]);
    stack.bind("c");
    stack.bind("b");
    stack.unbind("b");
    assert.equal(stack.bound, "c");
    stack.bind("b");
    stack.setNodes(["a", "c"], () => false);
    assert.equal(stack.bound, "c");
    stack.setNodes([], () => false);
    assert.equal(stack.bound, undefined);
  });

  test("is never empty while there are nodes", () => {
    const stack = stackOf(["a", "b"]);
    stack.unbind("a");
    assert.equal(stack.bound, "b");
    const only = stackOf(["a"]);
    only.unbind("a");
    assert.equal(only.bound, "a");
  });

  test("binds a new node that requests to be bound, but an old one only by `bind`", () => {
    const stack = stackOf(["a", "b"]);
    stack.setNodes(["a", "b"], () => true);
    assert.equal(stack.bound, "a");
    stack.setNodes(["a", "b", "c"], () => true);
    assert.equal(stack.bound, "c");
  });
});
