// The part "operators": the field `operators` of geometry nodes.

export { operatorReader } from "../../document/operatorReader.ts";
