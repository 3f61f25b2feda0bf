// The part "levels": meshes with levels of detail.

import { addDeliveries } from "../../delivery/lateDeliveries.ts";
import { deliverLevels } from "../../delivery/levels/levelDelivery.ts";

export function add(): void {
  addDeliveries({ levels: deliverLevels });
}
