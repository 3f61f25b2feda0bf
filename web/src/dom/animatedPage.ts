// Plays the animation of a page's scene: displays what it moves, reads what it writes, and tells it what it asks about
// the view. A module of its own, which pages load where their documents have nodes that send events.

import type { FieldChange } from "../animation/documentGraph.ts";
import type { AnimatedScene, PageDocuments } from "../animation/page/pageAnimation.ts";
import { PageAnimation } from "../animation/page/pageAnimation.ts";
import type { SceneReader } from "../document/sceneReader.ts";
import { interpolatorIdOf } from "../document/sequence.ts";
import { drawnFieldOf, isOfPose } from "../viewer/drawnFields.ts";
import { motionSphereOf } from "../viewer/motionSphere.ts";
import type { ViewerCore } from "../viewer/viewerCore.ts";
import { touchWritten } from "../viewer/writtenElements.ts";
import type { DisplayedScene } from "./displayedScene.ts";
import type { DocumentObserver } from "./documentObserver.ts";
import type { PageShape } from "./pageShapes.ts";
import type { PageView } from "./pageView.ts";
import { sceneSpaceOf } from "./sceneSpace.ts";

/** What is animated: a scene with its document and its view. */
export interface AnimatedPageScene {
  readonly view: Pick<PageView, "x3d" | "canvas" | "renderer" | "cameraController">;
  readonly core: Pick<
    ViewerCore<PageShape>,
    "reader" | "deliveries" | "inlines" | "log" | "read" | "scene" | "whenDisplayed" | "followMoves"
  >;
  readonly displayed: Pick<DisplayedScene, "isFramed" | "movePoses" | "followBind">;
  readonly observer: Pick<DocumentObserver, "writeUnobserved">;
}

export class AnimatedPage extends PageAnimation {
  readonly #scene: AnimatedPageScene;
  #isDisposed = false;

  /** `roots`: the elements of the documents that are animated. */
  constructor(scene: AnimatedPageScene, roots: () => readonly Element[], mayStartByItself: boolean) {
    super(documentsOf(scene, roots), animatedSceneOf(scene), mayStartByItself);
    this.#scene = scene;
  }

  /** The start view shows all moments of what moves, where it shows everything. Call when that may have changed. */
  showMotion(): void {
    const { core, displayed, view } = this.#scene;
    if (this.#isDisposed) return;
    core.whenDisplayed(() => {
      const { scene } = core;
      const visit = this.visitMoments.bind(this);
      view.cameraController.setMotion(scene && displayed.isFramed ? motionSphereOf(scene, visit) : undefined);
    });
  }

  override dispose(): void {
    this.#isDisposed = true;
    super.dispose();
  }
}

function documentsOf({ core }: AnimatedPageScene, roots: () => readonly Element[]): PageDocuments {
  return {
    get roots() {
      return roots();
    },
    documentOf: (inline) => core.inlines.documentOf(inline)?.x3d as Element | undefined,
  };
}

function animatedSceneOf({ view, core, displayed, observer }: AnimatedPageScene): AnimatedScene {
  const { reader, log } = core;
  const { geometries } = core.deliveries;
  return {
    ...sceneSpaceOf(view, core),
    drawnFieldOf,
    move: (changes) => {
      const poses = changes.every(isOfPose) ? changes : changes.filter(isOfPose); // without a copy where all are
      if (poses.length > 0) {
        displayed.movePoses(poses);
        core.followMoves();
      }
      if (poses.length === changes.length) return [];
      return changes.filter((change) => !isOfPose(change) && !movesVertices(reader, change));
    },
    read: (changes) => {
      for (const { element } of changes) touchWritten(reader, view.x3d, element);
      core.read();
      core.whenDisplayed(() => {
        // Elements of a page are DOM elements.
        for (const { element, attribute } of changes) displayed.followBind(element as unknown as Element, attribute);
      });
    },
    drawFrame: () => {
      view.renderer.draw();
    },
    showFraction: (interpolator, fraction) => {
      geometries.setFraction(interpolatorIdOf(interpolator), fraction);
    },
    sequenceDurationOf: (element) => geometries.sequenceDurationOf(interpolatorIdOf(element)),
    withoutReports: (write) => {
      observer.writeUnobserved(write);
    },
    touch: (element) => {
      reader.touch(element);
    },
    warn: (message) => {
      log.warn(message);
    },
  };
}

/** Gives a field of a geometry node or of its Coordinate other numbers; false: its attribute is to be read. */
function movesVertices(
  reader: Pick<SceneReader, "moveVertices">,
  { element, field, type, value }: FieldChange,
): boolean {
  return type.isList && type.size > 0 && reader.moveVertices(element, field, value as readonly number[]);
}
