import {
  adminOptions,
  defineOption,
  defineProgram,
  type OptionValues,
  proxies,
  schema,
} from '@farpoint/service';
import manifest from '../package.json' with { type: 'json' };
import { addressSchema, robotKeysOption, rulesSchema } from './option-values.ts';

export const program = defineProgram({
  name: 'farpoint-issuer',
  summary: 'Issues grants to people who sign in at an OpenID Connect provider.',
  version: manifest.version,
  section: 'issuer',
  options: {
    host: defineOption({
      schema: schema.text(),
      default: '127.0.0.1',
      argument: 'ADDRESS',
      help: 'address to listen on; 0.0.0.0 or :: for all interfaces',
    }),
    port: defineOption({
      schema: schema.port(),
      default: 3010,
      argument: 'PORT',
      help: 'port for /sign-in and /callback; 0 takes a free one',
    }),
    url: defineOption({
      schema: schema.optional(addressSchema),
      default: null,
      argument: 'URL',
      help: 'address by which browsers reach this program, e.g. https://issuer.example; also the issuer in its grants',
    }),
    pages: defineOption({
      schema: schema.list(addressSchema),
      default: [],
      argument: 'URL,…',
      help: 'pages that grants may be sent to, by their exact addresses without a query, e.g. https://teleop.example/',
    }),
    provider: defineOption({
      schema: schema.optional(addressSchema),
      default: null,
      argument: 'URL',
      help: 'the OpenID Connect provider: its issuer, below which /.well-known/openid-configuration is',
    }),
    clientId: defineOption({
      schema: schema.optional(schema.text({ max: 512 })),
      default: null,
      argument: 'ID',
      help: 'the name of this program at the provider',
    }),
    clientSecret: defineOption({
      schema: schema.optional(schema.secret(schema.text({ max: 4096 }))),
      default: null,
      argument: 'SECRET',
      help: 'its password there, unless it is a public client; set it in the environment or the file rather than as a flag',
      secret: true,
    }),
    scope: defineOption({
      schema: schema.text({ max: 512 }),
      default: 'openid profile email',
      argument: 'SCOPES',
      help: 'what to ask the provider for; openid must be among them',
    }),
    userInfo: defineOption({
      schema: schema.boolean(),
      default: false,
      help: 'also take claims from the provider’s UserInfo endpoint, for providers whose ID tokens have no groups',
    }),
    rules: defineOption({
      schema: rulesSchema,
      default: [],
      argument: 'JSON',
      help: 'who gets which grant: a list of {claim, value, role, robots}, of which the first that matches decides; better in the file',
    }),
    robotKeys: defineOption({
      schema: robotKeysOption,
      default: {},
      argument: 'JSON',
      help: 'thumbprints of robots’ keys by robot id, which grants pass on to operators; better in the file',
    }),
    hours: defineOption({
      schema: schema.number({ min: 0.05, max: 744 }),
      default: 12,
      argument: 'H',
      help: 'how long a grant is valid',
    }),
    key: defineOption({
      schema: schema.text(),
      default: 'grant-key.json',
      argument: 'FILE',
      help: 'the private key that signs grants (farpoint-signaling grant keygen)',
    }),
    signInsPerMinute: defineOption({
      schema: schema.integer({ min: 1, max: 100_000 }),
      default: 30,
      argument: 'N',
      help: 'maximum sign-ins a minute from one IPv4 address or one IPv6 /64',
    }),
    providerTimeoutMs: defineOption({
      schema: schema.integer({ min: 100, max: 60_000 }),
      default: 10_000,
      argument: 'MS',
      help: 'how long the provider may take to answer',
    }),
    trustProxy: defineOption({
      schema: proxies(),
      default: [],
      argument: 'ADDRESS,…',
      help: "take the browser's address from X-Forwarded-For of these proxies: addresses, networks, loopback, private",
    }),
    ...adminOptions(9700),
  },
});

export type IssuerOptions = OptionValues<typeof program.options>;
