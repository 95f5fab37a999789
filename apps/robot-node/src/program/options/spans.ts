/** Where spans of clouds and commands go. */
import { defineOption, optionGroup, schema } from '@farpoint/service';
import * as z from 'zod';

/** OTLP/HTTP's path for spans, which is appended to an endpoint. */
const TRACES_PATH = '/v1/traces';

const endpointSchema = z
  .url({ protocol: /^https?$/, error: 'must be an http:// or https:// address' })
  .refine(isPlain, 'must have no user, password, query or fragment');

export const spanOptions = optionGroup('spans', {
  otlpEndpoint: defineOption({
    schema: schema.optional(endpointSchema),
    default: null,
    argument: 'URL',
    help: 'export spans of clouds and commands to this OpenTelemetry collector by OTLP/HTTP, usually http://localhost:4318; /v1/traces is appended; at most 35 spans a second, 13 kbit/s; default: no spans',
  }),
});

/** Where an endpoint takes spans. */
export function tracesUrl(endpoint: string): string {
  const url = new URL(endpoint);
  url.pathname = url.pathname.replace(/\/+$/, '');
  if (!url.pathname.endsWith(TRACES_PATH)) url.pathname = url.pathname.replace(/\/$/, '') + TRACES_PATH;
  return url.href;
}

/** The audit log names the endpoint: secrets do not belong there. */
function isPlain(endpoint: string): boolean {
  if (!URL.canParse(endpoint)) return false;
  const { username, password, search, hash } = new URL(endpoint);
  return username + password + search + hash === '';
}
