/** What a client says to the server. Everything but subscribing is refused: the server is read-only. */
import * as z from 'zod';

/** No viewer has more panels than that; more is refused. */
const MOST_AT_ONCE = 1024;

const id = z.int().min(0).max(0xffff_ffff);
const schema = z.discriminatedUnion('op', [
  z.object({
    op: z.literal('subscribe'),
    subscriptions: z.array(z.object({ id, channelId: id })).max(MOST_AT_ONCE),
  }),
  z.object({ op: z.literal('unsubscribe'), subscriptionIds: z.array(id).max(MOST_AT_ONCE) }),
]);
export type ClientMessage = z.infer<typeof schema>;

/** Operations of the protocol that this server does not offer: they would change something on the robot. */
const NOT_OFFERED: readonly string[] = [
  'advertise',
  'unadvertise',
  'getParameters',
  'setParameters',
  'subscribeParameterUpdates',
  'unsubscribeParameterUpdates',
  'subscribeConnectionGraph',
  'unsubscribeConnectionGraph',
  'fetchAsset',
];

export type MessageRefusal =
  | 'binary' // client publications and service calls; neither is offered
  | 'not-json'
  | 'not-offered' // an operation that this server does not have
  | 'bad-message'; // an unknown operation, or fields that are missing or out of range

/** Why a message from a client is not obeyed. */
export class ClientMessageError extends Error {
  override readonly name = 'ClientMessageError';
  readonly reason: MessageRefusal;

  constructor(reason: MessageRefusal, what: string) {
    super(what);
    this.reason = reason;
  }
}

/** @throws {ClientMessageError} */
export function parseClientMessage(data: string | Uint8Array): ClientMessage {
  if (typeof data !== 'string')
    throw new ClientMessageError(
      'binary',
      'this server is read-only: clients publish nothing and call nothing',
    );
  let value: unknown;
  try {
    value = JSON.parse(data);
  } catch {
    throw new ClientMessageError('not-json', 'a message that is not JSON');
  }
  const parsed = schema.safeParse(value);
  if (parsed.success) return parsed.data;
  const { data: op = '' } = z
    .object({ op: z.string() })
    .transform((object) => object.op)
    .safeParse(value);
  if (NOT_OFFERED.includes(op))
    throw new ClientMessageError('not-offered', `this server is read-only: no ${op}`);
  const [issue] = parsed.error.issues;
  throw new ClientMessageError(
    'bad-message',
    `${issue?.path.join('.') || 'op'}: ${issue?.message ?? 'is not valid'}`,
  );
}
