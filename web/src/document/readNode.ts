// A node -> what it says: for itself at once, for those below it when it is known
// what is handed down to them.

import type { AnchorDescription, BackgroundDescription, GroupDescription, NodeDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { attributeOf, lowerNameOf } from "./element.ts";
import type { Vec3 } from "./fieldTypes.ts";
import { boxOf } from "./geometry.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { asViewpoint } from "./orthoViewpoint.ts";
import type { ShapeReading } from "./readShape.ts";
import { readShape } from "./readShape.ts";
import type { SceneDeclarations, ReadChildren, Inherited, SceneFragment, FragmentReader } from "./sceneFragment.ts";
import { declarationsOf, joinDeclarations, warningsOnly } from "./sceneFragment.ts";

/** A document that an Inline shows. */
export interface InlinedDocument {
  readonly url: string;
  /** Its <X3D>; the urls in it are absolute. */
  readonly x3d: SceneElement;
}

/** What reading a node needs besides its element. */
export interface NodeReading extends ShapeReading {
  /** The element of the page that stands for it. */
  readonly host: SceneElement;
  readonly childrenOf: (element: SceneElement) => readonly SceneElement[];
  readonly levelOf: (lod: SceneElement) => number | undefined;
  /** The elements of the document that an Inline shows; undefined where there is none, or none that may be shown. */
  readonly inlined: (inline: SceneElement) => SceneElement | undefined;
}

/** What is below other nodes are nodes too. */
export function isReadAsWhole(node: SceneElement): boolean {
  return lowerNameOf(node) === "shape";
}

/** `element` is who says it, `node` what it is: the same but for USE. */
export function readNode(element: SceneElement, node: SceneElement, reading: NodeReading): FragmentReader {
  const { warnings } = reading;
  switch (lowerNameOf(node)) {
    case "shape":
      return sayShape(element, node, reading);
    case "group":
    case "staticgroup":
      return sayGroup(node, readFields(node, nodeFields.Group, warnings), reading);
    case "anchor": {
      const { url, description, parameter, ...fields } = readFields(node, nodeFields.Anchor, warnings);
      const anchor: AnchorDescription = { element: node, urls: url, description, target: targetIn(parameter) };
      return sayGroup(node, fields, reading, url.length > 0 ? { anchor } : {});
    }
    case "collision":
      return sayGroup(node, readFields(node, nodeFields.Group, warnings), {
        ...reading,
        childrenOf: (of) => reading.childrenOf(of).filter(isSeenChild),
      });
    case "billboard": {
      const { axisOfRotation, ...fields } = readFields(node, nodeFields.Billboard, warnings);
      return sayGroup(node, fields, reading, { billboardAxis: axisOfRotation });
    }
    case "transform": {
      const transform = readFields(node, nodeFields.Transform, warnings);
      return sayGroup(node, transform, reading, { transform });
    }
    case "switch":
      return saySwitch(node, reading);
    case "lod":
      return sayLevels(node, reading);
    case "inline":
      return sayInline(node, reading);
    case "directionallight":
      return sayLight({ kind: "directional", ...readFields(node, nodeFields.DirectionalLight, warnings) }, warnings);
    case "pointlight":
      return sayLight({ kind: "point", ...readFields(node, nodeFields.PointLight, warnings) }, warnings);
    case "spotlight":
      return sayLight({ kind: "spot", ...readFields(node, nodeFields.SpotLight, warnings) }, warnings);
    case "viewpoint":
      return say(
        [{ kind: "viewpoint", element, viewpoint: readFields(node, nodeFields.Viewpoint, warnings) }],
        warningsOnly(warnings),
      );
    case "orthoviewpoint":
      return say(
        [{ kind: "viewpoint", element, viewpoint: asViewpoint(readFields(node, nodeFields.OrthoViewpoint, warnings)) }],
        warningsOnly(warnings),
      );
    case "navigationinfo":
      return say([], declarationsOf({ navigation: readFields(node, nodeFields.NavigationInfo, warnings), warnings }));
    case "background":
      return say([], declarationsOf({ background: readBackground(node, warnings), warnings }));
    default:
      return (inherited, below) => below(reading.childrenOf(node), inherited);
  }
}

/** The same whatever is handed down. */
function say(nodes: readonly NodeDescription[], asides: SceneDeclarations): FragmentReader {
  const said: SceneFragment = { nodes, declarations: asides };
  return () => said;
}

function sayLight(
  light: Extract<NodeDescription, { kind: "light" }>["light"],
  warnings: readonly Warning[],
): FragmentReader {
  return say([{ kind: "light", light }], warningsOnly(warnings));
}

function sayShape(element: SceneElement, node: SceneElement, reading: NodeReading): FragmentReader {
  const shape = readShape(element, reading.host, node, reading);
  const asides = warningsOnly(reading.warnings);
  return ({ visible, contributesToBounds: reaches, priority }) => ({
    nodes: [
      {
        ...shape,
        visible: visible && shape.visible,
        contributesToBounds: reaches && shape.contributesToBounds,
        priority: priority * shape.priority,
      },
    ],
    declarations: asides,
  });
}

function readBackground(node: SceneElement, warnings: Warning[]): BackgroundDescription {
  const { skyColor, skyAngle, groundColor, groundAngle } = readFields(node, nodeFields.Background, warnings);
  // The first colour is at the pole, each further one at its angle.
  const rings = (colors: readonly Vec3[], angles: readonly number[]) =>
    colors.slice(0, angles.length + 1).map((color, i) => ({ color, angle: i === 0 ? 0 : (angles[i - 1] ?? 0) }));
  return {
    sky: rings(skyColor.length > 0 ? skyColor : [[0, 0, 0]], skyAngle),
    ground: rings(groundColor, groundAngle),
  };
}

interface GroupFields {
  readonly visible: boolean;
  readonly render: boolean;
  readonly priority: number;
  readonly bboxCenter: Vec3;
  readonly bboxSize: Vec3;
}

function isSeen({ visible, render }: Pick<GroupFields, "visible" | "render">): boolean {
  return visible && render;
}

/** What a node with these fields hands down. */
function within(fields: GroupFields, inherited: Inherited): Inherited {
  const seen = isSeen(fields);
  return {
    visible: inherited.visible && seen,
    contributesToBounds: inherited.contributesToBounds && seen,
    priority: inherited.priority * fields.priority,
  };
}

/** What groups of a kind have besides. */
type GroupTraits = Partial<Pick<GroupDescription, "transform" | "billboardAxis" | "anchor">>;

function groupOf(
  fields: GroupFields,
  children: readonly NodeDescription[],
  traits: GroupTraits = {},
): GroupDescription {
  return { kind: "group", visible: isSeen(fields), box: boxOf(fields), transform: undefined, ...traits, children };
}

/** An Anchor's parameters are pairs `name=value`. */
function targetIn(parameter: readonly string[]): string {
  return (
    parameter.map((pair) => /^\s*target\s*=\s*(\S+)\s*$/i.exec(pair)?.[1]).find((target) => target !== undefined) ?? ""
  );
}

/** A Collision's proxy stands in for its children where people walk, not where they look. */
function isSeenChild(child: SceneElement): boolean {
  return attributeOf(child, "containerField") !== "proxy";
}

function sayGroup(
  node: SceneElement,
  fields: GroupFields,
  { warnings, childrenOf }: NodeReading,
  traits?: GroupTraits,
): FragmentReader {
  const own = warningsOnly(warnings);
  return (inherited, below) => {
    const { nodes, declarations: asides } = below(childrenOf(node), within(fields, inherited));
    return { nodes: [groupOf(fields, nodes, traits)], declarations: joinDeclarations([own, asides]) };
  };
}

/** One of its children is seen, or none; the others stay in the scene, so that choosing them shows at once what they have. */
function saySwitch(node: SceneElement, { warnings, childrenOf }: NodeReading): FragmentReader {
  const fields = readFields(node, nodeFields.Switch, warnings);
  const own = warningsOnly(warnings);
  return (inherited, below) =>
    sayChoice(choicesIn(childrenOf(node)), fields.whichChoice, false, fields, inherited, below, own);
}

/** Children that are no nodes of their own are none of the choices. */
function choicesIn(children: readonly SceneElement[]): SceneElement[] {
  return children.filter((child) => !lowerNameOf(child).startsWith("metadata"));
}

/** `allReach`: the scene reaches as far as those that are not chosen. */
function sayChoice(
  choices: readonly SceneElement[],
  choice: number,
  allReach: boolean,
  fields: GroupFields,
  inherited: Inherited,
  below: ReadChildren,
  own: SceneDeclarations,
  levels?: GroupDescription["lod"],
): SceneFragment {
  const each = choices.map((child, place) => {
    const visible = place === choice;
    const said = below(
      [child],
      within(fields, {
        ...inherited,
        visible: inherited.visible && visible,
        contributesToBounds: inherited.contributesToBounds && (visible || allReach),
      }),
    );
    const group: GroupDescription = {
      kind: "group",
      box: undefined,
      visible,
      transform: undefined,
      children: said.nodes,
    };
    return { group, asides: said.declarations };
  });
  const children = each.map(({ group }) => group);
  const group: GroupDescription = {
    kind: "group",
    box: undefined,
    visible: isSeen(fields),
    transform: undefined,
    children,
  };
  return {
    nodes: [levels === undefined ? group : { ...group, lod: levels }],
    declarations: joinDeclarations([own, ...each.map(({ asides }) => asides)]),
  };
}

/** A choice that the distance makes. Until it is known the last level is seen, which asks for least. */
function sayLevels(node: SceneElement, { warnings, childrenOf, levelOf }: NodeReading): FragmentReader {
  const { center, range, ...fields } = readFields(node, nodeFields.LOD, warnings);
  const own = warningsOnly(warnings);
  return (inherited, below) => {
    const choices = choicesIn(childrenOf(node));
    const last = choices.length - 1;
    const level = Math.min(levelOf(node) ?? last, last);
    return sayChoice(choices, level, true, fields, inherited, below, own, {
      element: node,
      center,
      range,
      levelCount: choices.length,
    });
  };
}

/** The document stands where the Inline does, with names of its own; what it says of the whole scene counts for nothing. */
function sayInline(node: SceneElement, { warnings, inlined }: NodeReading): FragmentReader {
  const { load, url, ...fields } = readFields(node, nodeFields.Inline, warnings);
  const x3d = load ? inlined(node) : undefined;
  const own = warningsOnly(warnings);
  return (inherited, below) => {
    const inner = within(fields, inherited);
    const inlines =
      load && url.length > 0 ? [{ element: node, urls: url, visible: inner.visible, priority: inner.priority }] : [];
    const { nodes, declarations: asides } = below(x3d ? [x3d] : [], inner);
    const ofItsScene = { ...asides, navigation: undefined, background: undefined };
    return {
      nodes: [{ ...groupOf(fields, nodes), ...(inlines.length > 0 && { inline: node }) }],
      declarations: joinDeclarations([declarationsOf({ inlines }), own, ofItsScene]),
    };
  };
}
