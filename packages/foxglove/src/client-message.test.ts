import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { ClientMessageError, parseClientMessage } from './client-message.ts';

function refusalOf(data: string | Uint8Array): string | null {
  try {
    parseClientMessage(data);
    return null;
  } catch (error) {
    if (error instanceof ClientMessageError) return error.reason;
    throw error;
  }
}

describe('parseClientMessage', () => {
  it('reads subscriptions', () => {
    const subscriptions = [{ id: 0, channelId: 4 }];
    expect(parseClientMessage(JSON.stringify({ op: 'subscribe', subscriptions }))).toEqual({
      ...{ op: 'subscribe', subscriptions },
    });
    expect(parseClientMessage('{"op":"unsubscribe","subscriptionIds":[0,1],"more":1}')).toEqual({
      ...{ op: 'unsubscribe', subscriptionIds: [0, 1] },
    });
  });

  it.each([
    [new Uint8Array([1, 0, 0, 0, 0]), 'binary'],
    ['', 'not-json'],
    ['{"op":', 'not-json'],
    ['{"op":"advertise","channels":[]}', 'not-offered'],
    ['{"op":"setParameters","parameters":[]}', 'not-offered'],
    ['{"op":"fetchAsset","uri":"file:///etc/passwd","requestId":1}', 'not-offered'],
    ['{"op":"dance"}', 'bad-message'],
    ['{"op":"constructor"}', 'bad-message'],
    ['null', 'bad-message'],
    ['{"op":"subscribe"}', 'bad-message'],
    ['{"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]}', 'bad-message'],
    ['{"op":"subscribe","subscriptions":[{"id":1.5,"channelId":1}]}', 'bad-message'],
    ['{"op":"unsubscribe","subscriptionIds":["1"]}', 'bad-message'],
    [`{"op":"unsubscribe","subscriptionIds":[${Array(2000).fill(1).join()}]}`, 'bad-message'],
  ])('refuses %s', (data, reason) => {
    expect(refusalOf(data)).toBe(reason);
  });

  it('gives a typed reason for anything', () => {
    fc.assert(fc.property(fc.oneof(fc.string(), fc.json(), fc.uint8Array()), (data) => void refusalOf(data)));
  });
});
