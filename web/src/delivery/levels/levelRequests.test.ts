import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { pngOf } from "../../decode/png.testing.ts";
import { deferredFile, siteOf } from "../delivery.testing.ts";
import { LevelRequests } from "./levelRequests.ts";

const image = pngOf({ width: 8, height: 4, colorType: 2 });
const turns = async (): Promise<void> => {
  for (let n = 0; n < 50; ++n) await new Promise((resolve) => setImmediate(resolve));
};

function requests(files: Parameters<typeof siteOf>[0]) {
  const site = siteOf(files);
  const failed: string[] = [];
  const made = new LevelRequests(site.pool, "levels.png", {
    onReceived: () => undefined,
    onError: (_, url) => failed.push(url),
  });
  return { site, failed, requests: made };
}

describe("requests of groups with images", () => {
  test("fetch the image beside the group, and free it when the group is forgotten", async () => {
    const { site, requests: made } = requests({ "0/3.png": deferredFile(image).promise, "0/3.webp": image });
    made.requestGroup(3, 1, 100, () => undefined);
    const arrived = await made.requestChips(3, 1, 200);
    assert.equal(await made.requestChips(3, 1, 200), arrived);
    await turns();
    assert.deepEqual(site.requested.toSorted(), ["0/3.png", "0/3.webp"]);
    assert.equal(site.textureImages.open, 1);
    assert.equal(made.transfers.length, 2);
    made.withdraw(3);
    await turns();
    assert.equal(site.textureImages.open, 0);
    assert.equal(made.transfers.length, 0);
  });

  test("fetch no image for a group that does not ask for it", async () => {
    const { site, requests: made } = requests({ "0/3.png": deferredFile(image).promise });
    made.requestGroup(3, 1, 100, () => undefined);
    await turns();
    assert.deepEqual(site.requested, ["0/3.png"]);
    made.withdrawAll();
  });

  test("free the image of a group that fails, and tell one error", async () => {
    const { site, failed, requests: made } = requests({ "0/3.png": 404, "0/3.webp": image });
    void made.requestChips(3, 1, 200);
    made.requestGroup(3, 1, 100, () => assert.fail());
    await turns();
    assert.deepEqual(failed, ["0/3.png"]);
    assert.equal(site.textureImages.open, 0);
    assert.equal(made.groups.size, 0);
  });
});
