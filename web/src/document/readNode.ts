// Reads a node: its own fields at once; its descendants when the state that they inherit is known.

import type {
  AnchorDescription,
  BackgroundNodeDescription,
  GroupDescription,
  NodeDescription,
  ShapeDescription,
  SkinDescription,
} from "./description.ts";
import { isOnlyNamed, readSkin } from "./deformation.ts";
import type { SceneElement } from "./element.ts";
import { attributeOf, lowerNameOf } from "./element.ts";
import type { Vec3 } from "./fieldTypes.ts";
import { boxOf } from "./geometry.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { asViewpoint } from "./orthoViewpoint.ts";
import { readBackground } from "./readBackground.ts";
import { readEnvironmentLight } from "./readCubeMap.ts";
import { readFog, readLocalFog } from "./readFog.ts";
import type { ShapeReadingContext } from "./readShape.ts";
import { nodesIn, readShape } from "./readShape.ts";
import type { SceneDeclarations, ReadChildren, Inherited, SceneFragment, FragmentReader } from "./sceneFragment.ts";
import { declarationsOf, joinDeclarations, warningsOnly } from "./sceneFragment.ts";

/** A loaded document of an Inline. */
export interface InlinedDocument {
  readonly url: string;
  /** Its <X3D> element, whose URLs are absolute. */
  readonly x3d: SceneElement;
}

/** The context that reading a node needs besides its element. */
export interface NodeReadingContext extends ShapeReadingContext {
  /** The page's element for the node: itself, or the Inline element whose document it is in. */
  readonly host: SceneElement;
  /** The number of Inlines around the node; 0 in the page's own document. */
  readonly inlineDepth: number;
  readonly childrenOf: (element: SceneElement) => readonly SceneElement[];
  readonly levelOf: (lod: SceneElement) => number | undefined;
  /** The root element of an Inline's document; undefined where it is not loaded or must not be inlined. */
  readonly inlined: (inline: SceneElement) => SceneElement | undefined;
}

/** Whether a node is read together with all its descendants, which are not nodes of the scene tree. */
export function isReadAsWhole(node: SceneElement): boolean {
  return ["shape", "texturebackground", "environmentlight"].includes(lowerNameOf(node));
}

/** Reads `element`. `node`: the element with its fields, which is the one that `element` USEs, or `element` itself. */
export function readNode(element: SceneElement, node: SceneElement, context: NodeReadingContext): FragmentReader {
  const { warnings } = context;
  switch (lowerNameOf(node)) {
    case "shape":
      return shapeReader(element, node, context);
    case "group":
    case "staticgroup":
    case "hanimsegment":
      return groupReader(node, readFields(node, nodeFields.Group, warnings), context);
    case "anchor": {
      const { url, description, parameter, ...fields } = readFields(node, nodeFields.Anchor, warnings);
      const anchor: AnchorDescription = { element: node, urls: url, description, target: targetIn(parameter) };
      return groupReader(node, fields, context, url.length > 0 ? { anchor } : {});
    }
    case "collision":
      return groupReader(node, readFields(node, nodeFields.Group, warnings), {
        ...context,
        childrenOf: (parent) => context.childrenOf(parent).filter(isVisibleChild),
      });
    case "billboard": {
      const { axisOfRotation, ...fields } = readFields(node, nodeFields.Billboard, warnings);
      return groupReader(node, fields, context, { billboardAxis: axisOfRotation });
    }
    case "transform":
    case "hanimjoint":
    case "hanimsite": {
      const transform = readFields(node, nodeFields.Transform, warnings);
      return groupReader(node, transform, context, { transform, transformElement: node });
    }
    case "hanimhumanoid": {
      const transform = readFields(node, nodeFields.HAnimHumanoid, warnings);
      const skin = readSkin(node, context.childrenOf(node), context.lookup, warnings);
      const drawn = { ...context, childrenOf: () => context.childrenOf(node).filter((child) => !isOnlyNamed(child)) };
      return groupReader(node, transform, drawn, { transform, transformElement: node }, skin);
    }
    case "hanimdisplacer":
      warnings.push({
        element: node,
        message:
          "has no effect on an HAnimJoint or HAnimSegment: pages move the vertices of a Shape that it is a child of",
      });
      return constantReader([], warningsOnly(warnings));
    case "hanimmotion":
      warnings.push({
        element: node,
        message: "has no effect: pages play interpolators whose values are routed to the joints",
      });
      return constantReader([], warningsOnly(warnings));
    case "switch":
      return switchReader(node, context);
    case "lod":
      return lodReader(node, context);
    case "inline":
      return inlineReader(node, context);
    case "directionallight":
      return lightReader({ kind: "directional", ...readFields(node, nodeFields.DirectionalLight, warnings) }, warnings);
    case "pointlight":
      return lightReader({ kind: "point", ...readFields(node, nodeFields.PointLight, warnings) }, warnings);
    case "spotlight":
      return lightReader({ kind: "spot", ...readFields(node, nodeFields.SpotLight, warnings) }, warnings);
    case "environmentlight":
      return constantReader(
        [readEnvironmentLight(element, node, (parent) => nodesIn(parent, context), warnings)],
        warningsOnly(warnings),
      );
    case "viewpoint":
      return constantReader(
        [{ kind: "viewpoint", element, viewpoint: readFields(node, nodeFields.Viewpoint, warnings) }],
        warningsOnly(warnings),
      );
    case "orthoviewpoint":
      return constantReader(
        [{ kind: "viewpoint", element, viewpoint: asViewpoint(readFields(node, nodeFields.OrthoViewpoint, warnings)) }],
        warningsOnly(warnings),
      );
    case "navigationinfo":
      return constantReader(
        [],
        declarationsOf({ navigation: readFields(node, nodeFields.NavigationInfo, warnings), warnings }),
      );
    case "clipplane":
      context.refusals?.warnOfFields(node, warnings);
      return constantReader(
        [{ kind: "clipPlane", ...readFields(node, nodeFields.ClipPlane, warnings) }],
        warningsOnly(warnings),
      );
    case "fog":
      return constantReader([readFog(element, node, context.inlineDepth, warnings)], warningsOnly(warnings));
    case "localfog":
      return constantReader([readLocalFog(node, warnings)], warningsOnly(warnings));
    case "background":
    case "texturebackground":
      return backgroundReader(
        readBackground(element, node, context.inlineDepth, (parent) => nodesIn(parent, context), warnings),
        warnings,
      );
    case "externalshape":
    case "bvhrefiner":
    case "multipart":
    case "dynamiclod":
      warnings.push({ element: node, message: context.refusals?.reasonAgainst(node) ?? "" });
      return constantReader([], warningsOnly(warnings));
    default:
      return (inherited, readChildren) => readChildren(context.childrenOf(node), inherited);
  }
}

/** Gives the same fragment for every inherited state. */
function constantReader(nodes: readonly NodeDescription[], declarations: SceneDeclarations): FragmentReader {
  const fragment: SceneFragment = { nodes, declarations };
  return () => fragment;
}

function backgroundReader(background: BackgroundNodeDescription, warnings: readonly Warning[]): FragmentReader {
  return constantReader([background], declarationsOf({ background, warnings }));
}

function lightReader(
  light: Extract<NodeDescription, { kind: "light" }>["light"],
  warnings: readonly Warning[],
): FragmentReader {
  return constantReader([{ kind: "light", light }], warningsOnly(warnings));
}

function shapeReader(element: SceneElement, node: SceneElement, context: NodeReadingContext): FragmentReader {
  const shape = readShape(element, context.host, node, context);
  const declarations = warningsOnly(context.warnings);
  return ({ visible, contributesToBounds, priority, skin }) => ({
    nodes: [
      {
        ...shape,
        ...deformerOf(shape, skin),
        visible: visible && shape.visible,
        contributesToBounds: contributesToBounds && shape.contributesToBounds,
        priority: priority * shape.priority,
      },
    ],
    declarations,
  });
}

/** Its deformer with the skin of the HAnimHumanoid around it. */
function deformerOf({ geometry, deformer }: ShapeDescription, skin: SkinDescription | undefined) {
  if (geometry?.deformation === undefined) return undefined;
  const own = geometry.deformation.layout.jointSets > 0 ? skin : undefined;
  const displacers = deformer?.displacers ?? [];
  return { deformer: own || displacers.length > 0 ? { skin: own, displacers } : undefined };
}

interface GroupFields {
  readonly visible: boolean;
  readonly render: boolean;
  readonly priority: number;
  readonly bboxCenter: Vec3;
  readonly bboxSize: Vec3;
}

function isVisible({ visible, render }: Pick<GroupFields, "visible" | "render">): boolean {
  return visible && render;
}

/** The state that the children of a node with these fields inherit. */
function inheritedByChildren(fields: GroupFields, inherited: Inherited): Inherited {
  const visible = isVisible(fields);
  return {
    visible: inherited.visible && visible,
    contributesToBounds: inherited.contributesToBounds && visible,
    priority: inherited.priority * fields.priority,
    skin: inherited.skin,
  };
}

/** Optional properties of groups. */
type GroupTraits = Partial<Pick<GroupDescription, "transform" | "transformElement" | "billboardAxis" | "anchor">>;

function groupOf(
  fields: GroupFields,
  children: readonly NodeDescription[],
  traits: GroupTraits = {},
): GroupDescription {
  return { kind: "group", visible: isVisible(fields), box: boxOf(fields), transform: undefined, ...traits, children };
}

/** The `target` among an Anchor's parameters, which are pairs `name=value`. */
function targetIn(parameter: readonly string[]): string {
  return (
    parameter.map((pair) => /^\s*target\s*=\s*(\S+)\s*$/i.exec(pair)?.[1]).find((target) => target !== undefined) ?? ""
  );
}

/** False for a Collision's proxy, which replaces the children for collisions only. */
function isVisibleChild(child: SceneElement): boolean {
  return attributeOf(child, "containerField") !== "proxy";
}

function groupReader(
  node: SceneElement,
  fields: GroupFields,
  { warnings, childrenOf }: NodeReadingContext,
  traits?: GroupTraits,
  skin?: SkinDescription,
): FragmentReader {
  const ownDeclarations = warningsOnly(warnings);
  return (inherited, readChildren) => {
    const inner = inheritedByChildren(fields, inherited);
    const { nodes, declarations } = readChildren(childrenOf(node), skin ? { ...inner, skin } : inner);
    return { nodes: [groupOf(fields, nodes, traits)], declarations: joinDeclarations([ownDeclarations, declarations]) };
  };
}

/**
 * At most one child is visible. The others stay in the scene: a child that is chosen later displays at once what has
 * been loaded of it.
 */
function switchReader(node: SceneElement, { warnings, childrenOf }: NodeReadingContext): FragmentReader {
  const fields = readFields(node, nodeFields.Switch, warnings);
  const ownDeclarations = warningsOnly(warnings);
  return (inherited, readChildren) =>
    choiceFragment(
      choicesIn(childrenOf(node)),
      fields.whichChoice,
      false,
      fields,
      inherited,
      readChildren,
      ownDeclarations,
    );
}

/** Metadata children are not choices. */
function choicesIn(children: readonly SceneElement[]): SceneElement[] {
  return children.filter((child) => !lowerNameOf(child).startsWith("metadata"));
}

/** `allContributeToBounds`: the scene's bounds include the choices that are not visible. */
function choiceFragment(
  choices: readonly SceneElement[],
  choice: number,
  allContributeToBounds: boolean,
  fields: GroupFields,
  inherited: Inherited,
  readChildren: ReadChildren,
  ownDeclarations: SceneDeclarations,
  levels?: GroupDescription["lod"],
): SceneFragment {
  const branches = choices.map((child, index) => {
    const visible = index === choice;
    const fragment = readChildren(
      [child],
      inheritedByChildren(fields, {
        ...inherited,
        visible: inherited.visible && visible,
        contributesToBounds: inherited.contributesToBounds && (visible || allContributeToBounds),
      }),
    );
    const group: GroupDescription = {
      kind: "group",
      box: undefined,
      visible,
      transform: undefined,
      children: fragment.nodes,
    };
    return { group, declarations: fragment.declarations };
  });
  const children = branches.map(({ group }) => group);
  const group: GroupDescription = {
    kind: "group",
    box: undefined,
    visible: isVisible(fields),
    transform: undefined,
    children,
  };
  return {
    nodes: [levels === undefined ? group : { ...group, lod: levels }],
    declarations: joinDeclarations([ownDeclarations, ...branches.map(({ declarations }) => declarations)]),
  };
}

/**
 * Chooses a level by distance. While the distance is unknown the last level is visible, which needs the fewest files.
 */
function lodReader(node: SceneElement, { warnings, childrenOf, levelOf }: NodeReadingContext): FragmentReader {
  const { center, range, ...fields } = readFields(node, nodeFields.LOD, warnings);
  const ownDeclarations = warningsOnly(warnings);
  return (inherited, readChildren) => {
    const choices = choicesIn(childrenOf(node));
    const last = choices.length - 1;
    const level = Math.min(levelOf(node) ?? last, last);
    return choiceFragment(choices, level, true, fields, inherited, readChildren, ownDeclarations, {
      element: node,
      center,
      range,
      levelCount: choices.length,
    });
  };
}

/**
 * The document replaces the Inline and has its own DEF names; its NavigationInfo has an effect only where the documents
 * around it have none.
 */
function inlineReader(node: SceneElement, { warnings, inlined }: NodeReadingContext): FragmentReader {
  const { load, url, ...fields } = readFields(node, nodeFields.Inline, warnings);
  const x3d = load ? inlined(node) : undefined;
  const ownDeclarations = warningsOnly(warnings);
  return (inherited, readChildren) => {
    const inner = inheritedByChildren(fields, inherited);
    const inlines =
      load && url.length > 0 ? [{ element: node, urls: url, visible: inner.visible, priority: inner.priority }] : [];
    const { nodes, declarations } = readChildren(x3d ? [x3d] : [], inner);
    const { navigation, inlinedNavigation } = declarations;
    const localDeclarations = {
      ...declarations,
      navigation: undefined,
      inlinedNavigation: navigation ?? inlinedNavigation,
    };
    return {
      nodes: [{ ...groupOf(fields, nodes), ...(inlines.length > 0 && { inline: node }) }],
      declarations: joinDeclarations([declarationsOf({ inlines }), ownDeclarations, localDeclarations]),
    };
  };
}
