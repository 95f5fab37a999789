import { type IceServer, iceServerSchema, signInUrlSchema, tokenSchema } from '@farpoint/protocol';
import { defineOption, defineProgram, type OptionValues, proxies, schema } from '@farpoint/service';
import * as z from 'zod';
import manifest from '../package.json' with { type: 'json' };
import { limitOptions } from './limit-options.ts';

const iceServers = z.preprocess((value, context) => {
  if (typeof value !== 'string') return value;
  try {
    return JSON.parse(value);
  } catch {
    context.addIssue({ code: 'custom', message: 'must be a list of RTCIceServer, as JSON' });
    return z.NEVER;
  }
}, z.array(iceServerSchema)) as z.ZodType<IceServer[]>;

/** Nothing else may get into the page's Content-Security-Policy. */
function isHttpsOrigin(text: string): boolean {
  return /^https:\/\/[a-z0-9.-]+(:\d{1,5})?$/i.test(text) && URL.canParse(text);
}

function isSocketOrigin(text: string): boolean {
  return /^wss?:\/\/[a-z0-9.-]+(:\d{1,5})?$/i.test(text) && URL.canParse(text);
}

const count = schema.integer({ min: 1 });

export const program = defineProgram({
  name: 'farpoint-signaling',
  summary: 'Introduces robots and operators: Farpoint sessions, and the signaling of the reference system.',
  version: manifest.version,
  section: 'signaling',
  commands: {
    grant: 'makes keys, issues, shows and revokes grants',
    audit: 'verifies an audit log',
  },
  options: {
    host: defineOption({
      schema: schema.text(),
      default: '127.0.0.1',
      argument: 'ADDRESS',
      help: 'address to listen on; 0.0.0.0 or :: for all interfaces',
    }),
    port: defineOption({
      schema: schema.port(),
      default: 3000,
      argument: 'PORT',
      help: 'port for /robot, /operator, /healthz and the web app; 0 takes a free one, here and below',
    }),
    reference: defineOption({
      schema: schema.boolean(),
      default: false,
      help: "also serve the reference system's protocol, on ports of its own",
    }),
    referenceRobotPort: defineOption({
      schema: schema.port(),
      default: 3001,
      argument: 'PORT',
      help: 'port for robots of the reference system',
    }),
    referenceClientPort: defineOption({
      schema: schema.port(),
      default: 3002,
      argument: 'PORT',
      help: 'port for clients of the reference system',
    }),
    referenceOpen: defineOption({
      schema: schema.boolean(),
      default: false,
      help: 'require no tokens on the ports of the reference system, even if tokens are set',
    }),
    open: defineOption({
      schema: schema.boolean(),
      default: false,
      help: 'let everybody in who reaches the service, without tokens; needed on anything but loopback, if there are none',
    }),
    plaintextTokens: defineOption({
      schema: schema.boolean(),
      default: false,
      help: 'take tokens without TLS from other machines, although others on the way can read them',
    }),
    publicMetrics: defineOption({
      schema: schema.boolean(),
      default: false,
      help: 'answer /metrics, and the details of /healthz, to everybody at --port; otherwise at --admin-port, and to whoever has --metrics-token',
    }),
    metricsToken: defineOption({
      schema: schema.optional(schema.secret(tokenSchema)),
      default: null,
      argument: 'TOKEN',
      help: 'answer /metrics at --port to whoever sends this token (Authorization: Bearer TOKEN); set it in the environment or the file rather than as a flag',
      secret: true,
    }),
    adminHost: defineOption({
      schema: schema.text(),
      default: '127.0.0.1',
      argument: 'ADDRESS',
      file: 'admin.host',
      help: 'address for --admin-port',
    }),
    adminPort: defineOption({
      schema: schema.optional(schema.port()),
      default: null,
      argument: 'PORT',
      file: 'admin.port',
      help: 'a port of its own for /metrics and /healthz with its details, which no proxy should pass on; default: none',
    }),
    webRoot: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'DIR',
      help: 'serve the built web app from this folder',
    }),
    mapOrigins: defineOption({
      schema: schema.list(schema.text()).refine((origins) => origins.every(isHttpsOrigin), {
        message: 'must be a list of https origins such as https://tiles.example',
      }),
      default: [],
      argument: 'ORIGIN,…',
      help: 'servers that the web app may fetch a map’s tiles from, e.g. https://tiles.example (default: only this one)',
    }),
    connectOrigins: defineOption({
      schema: schema.list(schema.text()).refine((origins) => origins.every(isSocketOrigin), {
        message: 'must be a list of origins such as wss://signaling.example',
      }),
      default: [],
      argument: 'ORIGIN,…',
      help: 'other servers that the web app may open WebSockets to, e.g. wss://janus.example (default: only this one, and bridges on the operator’s own machine)',
    }),
    tlsCert: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'FILE',
      help: 'certificate chain (PEM): HTTPS and WSS on every port; read again at SIGHUP',
    }),
    tlsKey: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'FILE',
      help: 'private key (PEM)',
    }),
    robotTokens: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'FILE',
      help: 'accept only robots with one of these tokens (YAML or JSON: robot id to token, or a list for any id); read again at SIGHUP',
    }),
    operatorTokens: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'FILE',
      help: 'accept only operators with one of these tokens (YAML or JSON: a list, or name to token); read again at SIGHUP',
    }),
    revocations: defineOption({
      schema: schema.list(schema.text()),
      default: [],
      argument: 'FILE,…',
      help: 'send robots these lists of revoked grants (from `farpoint-signaling grant revoke`), again whenever a file changes; the robots verify them',
    }),
    allowedOrigins: defineOption({
      schema: schema.list(schema.text()),
      default: [],
      argument: 'ORIGIN,…',
      help: 'also accept pages of these origins, e.g. https://teleop.example, or * for any; pages that this service serves and programs without an origin are always accepted',
    }),
    publicNames: defineOption({
      schema: schema.list(schema.text({ max: 253 })),
      default: [],
      argument: 'NAME,…',
      help: 'names by which browsers reach this service without TLS of its own, e.g. teleop.example behind a proxy; addresses, localhost and the machine’s own name always work',
    }),
    signInUrl: defineOption({
      schema: schema.optional(signInUrlSchema),
      default: null,
      argument: 'URL',
      help: 'where operators sign in for a grant: the address of farpoint-issuer, e.g. https://issuer.example/sign-in',
    }),
    trustProxy: defineOption({
      schema: proxies(),
      default: [],
      argument: 'ADDRESS,…',
      help: "take the peer's address from X-Forwarded-For of these proxies: addresses, networks such as 10.0.0.0/8, loopback, private",
    }),
    iceServers: defineOption({
      schema: iceServers,
      default: [],
      argument: 'JSON',
      help: 'RTCIceServer list for both peers, e.g. [{"urls":"stun:stun.example:3478"}]',
      secret: true,
    }),
    turnUrls: defineOption({
      schema: schema.list(schema.text()),
      default: [],
      argument: 'URL,…',
      help: 'TURN servers that share --turn-secret with this service (coturn: use-auth-secret)',
    }),
    turnSecret: defineOption({
      schema: schema.optional(schema.secret(schema.text())),
      default: null,
      argument: 'SECRET',
      help: 'secret from which the credentials for --turn-urls are made; set it in the environment or the file rather than as a flag',
      secret: true,
    }),
    turnTtlSeconds: defineOption({
      schema: schema.integer({ min: 60 }),
      default: 86_400,
      argument: 'S',
      help: 'how long those credentials are valid',
    }),
    ...limitOptions,
    auditLog: defineOption({
      schema: schema.optional(schema.text()),
      default: null,
      argument: 'FILE',
      help: 'record connections, sessions and refusals in this file, in a chain that shows every change (`farpoint-signaling audit verify`); default: not recorded',
    }),
    auditMax: defineOption({
      schema: schema.size({ min: 100_000 }),
      default: 64e6,
      argument: 'SIZE',
      help: 'audit: begin a new file when the old one has this size; the old one is renamed and kept',
    }),
    shutdownMs: defineOption({
      schema: count,
      default: 2000,
      argument: 'MS',
      help: 'how long peers may take to disconnect at shutdown',
    }),
  },
});

export type SignalingOptions = OptionValues<typeof program.options>;

/** All options at their defaults. */
export function defaultOptions(): SignalingOptions {
  return Object.fromEntries(
    Object.entries(program.options).map(([key, spec]) => [key, spec.default]),
  ) as SignalingOptions;
}
