// The part "streams": live streams, and sequences of frames. Their static files are images of classic.

import { add as addFiles } from "./files.ts";
import { addEncodings } from "../../delivery/encodings/encodings.ts";
import { liveDelivery } from "../../delivery/encodings/live/liveDelivery.ts";
import { addDeliveries } from "../../delivery/lateDeliveries.ts";
import { deliverStream } from "../../delivery/live/streamDelivery.ts";
import { SequenceDelivery } from "../../delivery/sequence/sequenceDelivery.ts";

export function add(): void {
  addFiles();
  addEncodings({ live: liveDelivery });
  addDeliveries({
    stream: deliverStream,
    sequence: (...needed) => new SequenceDelivery(...needed),
  });
}
