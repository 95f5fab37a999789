/** What is recorded about who did what. */
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const auditOptions = optionGroup('audit', {
  auditLog: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    file: 'log',
    help: 'record sessions, leases, emergency stops and refusals in this file, in a chain that shows every change (`farpoint-robot audit verify`); default: not recorded',
  }),
  auditMax: defineOption({
    schema: schema.size({ min: 100_000 }),
    default: 64e6,
    argument: 'SIZE',
    file: 'max',
    help: 'audit: begin a new file when the old one has this size; the old one is renamed and kept',
  }),
});
