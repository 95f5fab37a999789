/** Who is admitted. */
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const accessOptions = optionGroup('access', {
  grantKeys: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'admit only operators with a grant that one of these public keys signed (a JWK set, from `farpoint-signaling grant keygen`); read again at SIGHUP',
  }),
  robotKey: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'the private key by which operators recognise this robot; made if it does not exist; default: in --state-dir',
  }),
  watchersPoint: defineOption({
    schema: schema.boolean(),
    default: false,
    help: 'operators whose grant lets them only watch may also point at a spot that the others see',
  }),
  revocations: defineOption({
    schema: schema.list(schema.text()),
    default: [],
    argument: 'FILE,…',
    help: 'lists of revoked grants (from `farpoint-signaling grant revoke`), besides those that the signaling service sends; read again whenever one changes',
  }),
});
