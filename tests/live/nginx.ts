// Runs nginx with the configuration of docs/live.md, which tests and benchmarks put in front of a server of streams.

import { spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { connect as connectPlainly } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { connect } from "node:tls";
import { freePort } from "../browser/freePort.ts";

const binaries = ["/usr/sbin/nginx", "/usr/local/sbin/nginx", "/usr/local/bin/nginx"];

/** The program; undefined if it is not installed. */
export function findNginx(): string | undefined {
  return binaries.find((path) => spawnSync(path, ["-v"]).status === 0);
}

/** The configuration as the document has it. */
export function documentedConfiguration(): string {
  const document = readFileSync("docs/live.md", "utf8");
  const [, configuration] = /^```nginx\n([^]*?)^```/m.exec(document) ?? [];
  if (configuration === undefined) throw new Error("docs/live.md has no configuration of nginx");
  return configuration;
}

export interface RequestCounts {
  /** Requests for frames that viewers sent. */
  readonly frames: number;
  /** How many of them reached the server behind nginx. */
  readonly passed: number;
  /** How often each status of the cache was noted: HIT, MISS ... */
  readonly statuses: Readonly<Record<string, number>>;
}

export interface Nginx {
  readonly port: number;
  /** The number of its main process. */
  readonly pid: number;
  /** The certificate, which only these tests trust. */
  readonly certificate: string;
  /** Requests that have been answered since the start. */
  counts(): RequestCounts;
  stop(): Promise<void>;
}

/** Replaces a part of the configuration, which must be there once. */
function replaced(configuration: string, part: string, by: string): string {
  if (configuration.split(part).length !== 2) throw new Error(`the configuration has not one "${part}"`);
  return configuration.replace(part, () => by);
}

/** Starts nginx in front of the server at a local port, with TLS as the document has it or without. */
export async function startNginx(nginx: string, serverPort: number, hasTls = true): Promise<Nginx> {
  const folder = mkdtempSync(join(tmpdir(), "imgeo-nginx-"));
  const file = (name: string): string => join(folder, name);
  const port = await freePort();
  const made = spawnSync("openssl", [
    ...["req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2"],
    ...["-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost,IP:127.0.0.1"],
    ...["-keyout", file("live.key"), "-out", file("live.pem")],
  ]);
  if (made.status !== 0) throw new Error(`openssl: ${made.stderr.toString()}`);
  let configuration = documentedConfiguration();
  for (const [part, by] of [
    hasTls ? ["listen 443 ssl", `listen 127.0.0.1:${port} ssl`] : ["listen 443 ssl http2", `listen 127.0.0.1:${port}`],
    ["server 127.0.0.1:8090;", `server 127.0.0.1:${serverPort};`],
    ["/etc/ssl/certs/live.pem", file("live.pem")],
    ["/etc/ssl/private/live.key", file("live.key")],
    ["/var/cache/nginx/imgeo", file("cache")],
    // What the package's own configuration states for every server, and what the tests count.
    [
      "http {\n",
      `http {
  log_format counts "$uri $upstream_cache_status $upstream_addr";
  access_log ${file("access.log")} counts;
  ${["client_body", "proxy", "fastcgi", "uwsgi", "scgi"].map((name) => `${name}_temp_path ${file(name)};`).join("\n  ")}
`,
    ],
  ] as const)
    configuration = replaced(configuration, part, by);
  const asRoot = process.getuid?.() === 0 ? "user root;\n" : "";
  writeFileSync(file("nginx.conf"), `${asRoot}daemon off;\npid ${file("pid")};\n${configuration}`);
  const child = spawn(nginx, ["-p", folder, "-c", file("nginx.conf"), "-e", file("error.log")], { stdio: "ignore" });
  const ended = once(child, "exit");
  const certificate = readFileSync(file("live.pem"), "utf8");
  for (const end = Date.now() + 10_000; !(await answers(port, hasTls ? certificate : undefined));) {
    if (child.exitCode !== null || Date.now() > end)
      throw new Error(`nginx does not start: ${readFileSync(file("error.log"), "utf8")}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  return {
    port,
    pid: child.pid ?? 0,
    certificate,
    counts: () => countsOf(readFileSync(file("access.log"), "utf8")),
    stop: async () => {
      child.kill("SIGTERM");
      await ended;
      rmSync(folder, { recursive: true });
    },
  };
}

/** Whether somebody listens at a port, with TLS where there is a certificate. */
function answers(port: number, certificate: string | undefined): Promise<boolean> {
  return new Promise((resolve) => {
    const onConnect = (): void => {
      socket.end();
      resolve(true);
    };
    const options = { port, host: "127.0.0.1" };
    const socket =
      certificate === undefined
        ? connectPlainly(options, onConnect)
        : connect({ ...options, ca: certificate }, onConnect);
    socket.once("error", () => {
      resolve(false);
    });
  });
}

function countsOf(log: string): RequestCounts {
  const statuses: Record<string, number> = {};
  let [frames, passed] = [0, 0];
  for (const line of log.split("\n")) {
    const [path = "", status = "", upstream = ""] = line.split(" ");
    if (!path.includes("/frames/")) continue;
    frames += 1;
    if (upstream !== "-") passed += 1;
    statuses[status] = (statuses[status] ?? 0) + 1;
  }
  return { frames, passed, statuses };
}
