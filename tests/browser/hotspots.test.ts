// Tests hotspots: where they are displayed, whether they are visible, and that they follow their elements.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { center } from "./gestures.ts";
import { settle, until } from "./harness.ts";
import { soakTest } from "./soak.ts";
import { viewEvents } from "./viewEvents.ts";
import { assertNear, siteWith, withScene } from "./viewSites.ts";

describe("hotspots", () => {
  const inside = `<button slot="hotspot-front" id="front" data-position="0 0 1.5" data-normal="0 0 1" data-visibility-attribute="visible">Front</button>
    <a slot="hotspot-back" id="back" href="#" data-position="0m 0m -1.5m" data-normal="0m 0m -1m" data-visibility-attribute="visible">Back</a>`;
  const site = (): string =>
    siteWith("hotspots", {
      inside,
      attributes: 'camera-orbit="0deg 90deg 10m" camera-target="0 0 0" field-of-view="45deg"',
    });

  test("are displayed at their projected positions, and follow the camera", async () => {
    await withScene(site(), {}, async (view) => {
      const middle = async (): Promise<[number, number]> =>
        view.page.evaluate(() => {
          const { x, y, width, height } = document.querySelector("#front")!.getBoundingClientRect();
          return [x + width / 2, y + height / 2];
        });
      await settle(view.page);
      assert.deepEqual((await middle()).map(Math.round), [center.x, center.y]);
      await view.page.evaluate(() => {
        document.querySelector("x3d")!.setAttribute("camera-orbit", "40deg 90deg 10m");
      });
      await settle(view.page);
      // The eye is at 10 (sin 40, 0, cos 40); the hotspot is at z = 1.5.
      const angle = (40 * Math.PI) / 180;
      const [sideways, away] = [-1.5 * Math.sin(angle), 10 - 1.5 * Math.cos(angle)];
      const focal = center.y / Math.tan(Math.PI / 8);
      const [x, y] = await middle();
      assertNear(x, center.x + (focal * sideways) / away, 0.6);
      assertNear(y, center.y, 0.6);
    });
  });

  test("report whether they face the camera and are not covered, and stay readable and focusable", async () => {
    await withScene(site(), {}, async (view) => {
      const visible = async (id: string): Promise<boolean> =>
        view.page.evaluate((name) => document.querySelector(name)!.hasAttribute("data-visible"), id);
      await settle(view.page);
      assert.deepEqual([await visible("#front"), await visible("#back")], [true, false]);
      await view.page.evaluate(() => {
        document.querySelector("x3d")!.setAttribute("camera-orbit", "180deg 90deg 10m");
      });
      await until(
        "the other hotspot faces the camera",
        async () => !(await visible("#front")) && (await visible("#back")),
      );
      assert.ok((await viewEvents(view, "hotspot-visibility")).length >= 4);
      assert.equal(await view.page.getByRole("button", { name: "Front" }).count(), 1);
      await view.page.keyboard.press("Tab");
      await view.page.keyboard.press("Tab");
      assert.equal(await view.page.evaluate(() => document.activeElement?.id), "front");

      const frames = await view.page.evaluate(() => {
        const x3d = document.querySelector("x3d") as unknown as HTMLElement & {
          positionAndNormalFromPoint: (
            x: number,
            y: number,
          ) => { position: { x: number; y: number; z: number } } | null;
          getCameraPosition: () => { x: number; y: number; z: number };
        };
        const { left, top, width, height } = x3d.getBoundingClientRect();
        const eye = x3d.getCameraPosition();
        // One hotspot on the shape, and one on the same ray behind it.
        const [hit] = Array.from({ length: 40 }, (_, i) =>
          x3d.positionAndNormalFromPoint(left + (width * (i + 0.5)) / 40, top + height / 2),
        ).filter((found) => found !== null);
        const along = (share: number): string =>
          (["x", "y", "z"] as const).map((axis) => eye[axis] + share * (hit!.position[axis] - eye[axis])).join(" ");
        for (const [id, share] of [
          ["surface", 1],
          ["within", 1.2],
        ] as const) {
          const hotspot = document.createElement("button");
          [hotspot.id, hotspot.slot, hotspot.textContent] = [id, `hotspot-${id}`, id];
          hotspot.setAttribute("data-position", along(share));
          hotspot.setAttribute("data-visibility-attribute", "visible");
          x3d.append(hotspot);
        }
        return (x3d as unknown as { statistics: { frames: number } }).statistics.frames;
      });
      await until("one hotspot is covered", async () => (await visible("#surface")) && !(await visible("#within")));
      await settle(view.page);
      assert.deepEqual(
        [await visible("#surface"), await visible("#within"), await visible("#back")],
        [true, false, true],
      );
      await until("it gives way to the one in front of it", () =>
        view.page.evaluate(() => getComputedStyle(document.querySelector("#within")!).opacity === "0"),
      );
      await until("one that is covered and free has faded", () =>
        view.page.evaluate(() => getComputedStyle(document.querySelector("#front")!).opacity === "0.25"),
      );
      assert.ok(
        (await view.page.evaluate(
          () => (document.querySelector("x3d") as unknown as { statistics: { frames: number } }).statistics.frames,
        )) <=
          frames + 2,
      );
      await view.page.getByRole("button", { name: "within" }).focus();
      assert.equal(await view.page.evaluate(() => document.activeElement?.id), "within");
    });
  });

  soakTest("follow their elements, without a new reading of the scene", async () => {
    await withScene(site(), {}, async (view) => {
      const requestCount = view.server.requests.length;
      await view.page.evaluate(() => {
        document.querySelector("#front")!.setAttribute("data-position", "0 2 0");
        const added = document.querySelector("#back")!.cloneNode(true) as Element;
        added.id = "added";
        added.slot = "hotspot-added";
        added.setAttribute("data-position", "0 -2 0");
        document.querySelector("x3d")!.append(added);
      });
      await settle(view.page);
      const top = async (id: string): Promise<number> =>
        view.page.evaluate((name) => document.querySelector(name)!.getBoundingClientRect().y, id);
      assert.ok((await top("#front")) < center.y - 50 && (await top("#added")) > center.y + 50);
      await view.page.evaluate(() => {
        document.querySelector("#added")!.remove();
      });
      await until("its frame is removed", async () =>
        view.page.evaluate(
          () => document.querySelector("imgeo-view")!.shadowRoot!.querySelectorAll(".hotspots > div").length === 2,
        ),
      );
      assert.equal(view.server.requests.length, requestCount);
    });
  });
});
