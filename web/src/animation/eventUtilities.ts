// X3D's sequencers, filters and triggers (ISO/IEC 19775-1, clause 30).

import type { Behaviour, EventNode } from "./eventNode.ts";
import type { Value } from "./fieldTypes.ts";
import { isAscending, lastKeyUpTo } from "./keys.ts";
import type { NodeType } from "./nodeType.ts";
import { inputOnly, inputOutput, nodeType, outputOnly } from "./nodeType.ts";

/** Sends the value of the last key that a fraction has reached, whenever that is another key's. */
class Sequencer implements Behaviour {
  readonly #node: EventNode;
  #index: number | undefined;
  #isUsable: boolean | undefined;

  constructor(node: EventNode) {
    this.#node = node;
  }

  receive(field: string, value: Value): void {
    const keys = this.#node.numbersOf("key");
    const values = this.#node.valueOf("keyValue") as readonly (number | boolean)[];
    switch (field) {
      case "set_fraction":
        this.#isUsable ??= this.#check(keys, values);
        if (this.#isUsable)
          this.#go(
            Math.max(0, lastKeyUpTo(keys, Math.min(keys.length, values.length), value as number)),
            values,
            false,
          );
        break;
      case "next":
        if (value === true && values.length > 0) this.#go(((this.#index ?? -1) + 1) % values.length, values, true);
        break;
      case "previous":
        if (value === true && values.length > 0)
          this.#go(((this.#index ?? 0) + values.length - 1) % values.length, values, true);
        break;
      default:
        this.#isUsable = undefined;
        this.#index = undefined;
    }
  }

  #go(index: number, values: readonly (number | boolean)[], always: boolean): void {
    if (index === this.#index && !always) return;
    this.#index = index;
    const value = values[index];
    if (value !== undefined) this.#node.send("value_changed", value);
  }

  #check(keys: readonly number[], values: readonly unknown[]): boolean {
    if (!isAscending(keys)) {
      this.#node.warn("has keys that are not in ascending order, and sends no events for fractions");
      return false;
    }
    const count = Math.min(keys.length, values.length);
    if (keys.length !== values.length)
      this.#node.warn(
        `has ${keys.length} keys and ${values.length} values${count > 0 ? `: only the first ${count} of both count` : ", and sends no events for fractions"}`,
      );
    return count > 0;
  }
}

function sequencer(valueType: string, listType: string): NodeType {
  return nodeType(
    {
      set_fraction: inputOnly("SFFloat"),
      next: inputOnly("SFBool"),
      previous: inputOnly("SFBool"),
      key: inputOutput("MFFloat", []),
      keyValue: inputOutput(listType, []),
      value_changed: outputOnly(valueType),
    },
    (node) => new Sequencer(node),
  );
}

/** A node without memory besides its fields. */
function reaction(react: (node: EventNode, field: string, value: Value, time: number) => void) {
  return (node: EventNode): Behaviour => ({
    receive(field, value, time) {
      react(node, field, value, time);
    },
  });
}

export const eventUtilities = {
  BooleanFilter: nodeType(
    {
      set_boolean: inputOnly("SFBool"),
      inputTrue: outputOnly("SFBool"),
      inputFalse: outputOnly("SFBool"),
      inputNegate: outputOnly("SFBool"),
    },
    reaction((node, _, value) => {
      node.send(value === true ? "inputTrue" : "inputFalse", value);
      node.send("inputNegate", value !== true);
    }),
  ),
  BooleanSequencer: sequencer("SFBool", "MFBool"),
  BooleanToggle: nodeType(
    { set_boolean: inputOnly("SFBool"), toggle: inputOutput("SFBool", false) },
    reaction((node, field, value) => {
      if (field === "set_boolean" && value === true) node.send("toggle", !node.isTrue("toggle"));
    }),
  ),
  BooleanTrigger: nodeType(
    { set_triggerTime: inputOnly("SFTime"), triggerTrue: outputOnly("SFBool") },
    reaction((node) => {
      node.send("triggerTrue", true);
    }),
  ),
  IntegerSequencer: sequencer("SFInt32", "MFInt32"),
  IntegerTrigger: nodeType(
    {
      set_boolean: inputOnly("SFBool"),
      integerKey: inputOutput("SFInt32", -1),
      triggerValue: outputOnly("SFInt32"),
    },
    reaction((node, field) => {
      if (field === "set_boolean") node.send("triggerValue", node.numberOf("integerKey"));
    }),
  ),
  TimeTrigger: nodeType(
    { set_boolean: inputOnly("SFBool"), triggerTime: outputOnly("SFTime") },
    reaction((node, _, __, time) => {
      node.send("triggerTime", time);
    }),
  ),
} as const satisfies Readonly<Record<string, NodeType>>;
