// The names of the nodes that routes lead between: DEF of the route's document, and nodes of inlined documents that an
// IMPORT names and their EXPORT lets out (ISO/IEC 19775-1, 4.4.6).

import type { AnimatedElement } from "./elements.ts";
import { attributeIn } from "./elements.ts";

/** A document and those that it inlines, at any depth. */
export interface AnimatedDocuments {
  /** Their root elements. */
  readonly roots: readonly AnimatedElement[];
  /** The root of the document that an Inline displays; undefined before it has loaded. */
  documentOf(inline: AnimatedElement): AnimatedElement | undefined;
}

/** What a name stands for, or what is wrong with it; undefined for a node of a document that has not loaded yet. */
export type NamedNode =
  | { readonly element: AnimatedElement; readonly fault?: undefined }
  | { readonly element?: undefined; readonly fault: string }
  | undefined;

/** A ROUTE as its document states it. */
export interface StatedRoute {
  readonly fromNode: string;
  readonly fromField: string;
  readonly toNode: string;
  readonly toField: string;
}

/** The statements of one document. */
class Scope {
  readonly defined = new Map<string, AnimatedElement>();
  readonly imports = new Map<string, AnimatedElement>();
  /** The names of nodes in the document, by those that other documents import. */
  readonly exports = new Map<string, string>();
  /** By their text: a second one has no effect. */
  readonly routes = new Map<string, StatedRoute>();
}

export class DocumentNames {
  readonly #documents: AnimatedDocuments;
  readonly #scopes: ReadonlyMap<AnimatedElement, Scope>;

  /** Reads all documents. `onNode` is called with each element that is neither a statement nor a USE, in order. */
  constructor(documents: AnimatedDocuments, onNode: (element: AnimatedElement) => void) {
    this.#documents = documents;
    this.#scopes = new Map(documents.roots.map((root) => [root, scopeOf(root, onNode)]));
  }

  /** All ROUTEs, with the two nodes that they name. */
  *routes(): Generator<{ readonly label: string; readonly route: StatedRoute; readonly ends: readonly NamedNode[] }> {
    for (const scope of this.#scopes.values())
      for (const [label, route] of scope.routes) {
        const ends = [route.fromNode, route.toNode].map((name) => this.#named(scope, name, new Set()));
        yield { label, route, ends };
      }
  }

  /** `visited`: scopes through which the name has been imported. */
  #named(scope: Scope, name: string, visited: Set<Scope>): NamedNode {
    const defined = scope.defined.get(name);
    if (defined) return { element: defined };
    const statement = scope.imports.get(name);
    if (!statement) return { fault: `no node has DEF="${name}"` };
    const inlineName = attributeIn(statement, "inlineDEF") ?? "";
    const inline = scope.defined.get(inlineName);
    if (!inline) return { fault: `IMPORT "${name}": no Inline has DEF="${inlineName}"` };
    const root = this.#documents.documentOf(inline);
    const imported = root && this.#scopes.get(root);
    if (!imported) return undefined;
    const exportedName = attributeIn(statement, "importedDEF") ?? "";
    const local = visited.has(imported) ? undefined : imported.exports.get(exportedName);
    if (local === undefined)
      return { fault: `IMPORT "${name}": the document of "${inlineName}" does not export "${exportedName}"` };
    return this.#named(imported, local, visited.add(imported));
  }
}

function scopeOf(root: AnimatedElement, onNode: (element: AnimatedElement) => void): Scope {
  const scope = new Scope();
  const visit = (element: AnimatedElement): void => {
    const name = attributeIn(element, "DEF");
    if (name !== undefined && !scope.defined.has(name)) scope.defined.set(name, element);
    if (!addStatement(element, scope) && attributeIn(element, "USE") === undefined) onNode(element);
    for (const child of Array.from(element.children)) visit(child);
  };
  visit(root);
  return scope;
}

function addRoute(element: AnimatedElement, routes: Map<string, StatedRoute>): void {
  const field = (name: string): string => attributeIn(element, name)?.trim() ?? "";
  const route = {
    fromNode: field("fromNode"),
    fromField: field("fromField"),
    toNode: field("toNode"),
    toField: field("toField"),
  };
  routes.set(`ROUTE ${route.fromNode}.${route.fromField} TO ${route.toNode}.${route.toField}`, route);
}

/** Adds a ROUTE, IMPORT or EXPORT to its document. Returns whether the element is one. */
function addStatement(element: AnimatedElement, { routes, imports, exports }: Scope): boolean {
  const localName = attributeIn(element, "localDEF") ?? "";
  switch (element.localName.toLowerCase()) {
    case "route":
      addRoute(element, routes);
      return true;
    case "import":
      imports.set(attributeIn(element, "AS") ?? attributeIn(element, "importedDEF") ?? "", element);
      return true;
    case "export":
      exports.set(attributeIn(element, "AS") ?? localName, localName);
      return true;
    default:
      return false;
  }
}
