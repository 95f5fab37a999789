import { defineOption, schema } from '@farpoint/service';

/** Printed before it is opened, so it cannot be a free one. */
const PORT = schema.integer({ min: 1, max: 65_535 });

/** The options of `--lan`. */
export const lanOptions = {
  lan: defineOption({
    schema: schema.boolean(),
    default: false,
    help: 'also serve the local network, by HTTPS on --lan-port, with a certificate of an authority that this program makes; a page on --lan-install-port says how a headset comes to trust it',
  }),
  lanPort: defineOption({
    schema: PORT,
    default: 8443,
    argument: 'PORT',
    help: 'lan: port for everything that --port has, on all interfaces',
  }),
  lanInstallPort: defineOption({
    schema: PORT,
    default: 8080,
    argument: 'PORT',
    help: 'lan: port for the page about the certificate, which a browser opens before it trusts it',
  }),
  lanHosts: defineOption({
    schema: schema.list(schema.text()),
    default: [],
    argument: 'HOST,…',
    help: 'lan: further names and addresses of this machine for the certificate, the first one for the printed address, e.g. teleop.local',
  }),
  authorityDir: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'DIR',
    help: 'lan: where the authority’s certificate and key are kept (default: ~/.config/farpoint/authority)',
  }),
  pairKey: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'lan: the private key that signs grants; a browser then gets one for a code of six digits, which this program shows in its terminal; robots need the public key (--grant-keys)',
  }),
  pairHours: defineOption({
    schema: schema.number({ min: 0.05, max: 744 }),
    default: 12,
    argument: 'H',
    help: 'lan: how long such a grant is valid',
  }),
} as const;
