import type { ReferenceRobot } from '@farpoint/protocol';
import { describe, expect, it } from 'vitest';
import { OfferBoard } from './offer-board.ts';

function robot(id: number, more: Partial<ReferenceRobot> = {}): ReferenceRobot {
  return {
    id,
    name: 'robot',
    sdpOffer: `offer ${id}`,
    sdpAnswer: null,
    robotCandidates: [],
    clientCandidates: [],
    ...more,
  };
}

const idsOf = (offers: { robotId: number }[]) => offers.map(({ robotId }) => robotId);

describe('OfferBoard', () => {
  it('answers robots with its name that have offered, from the list and as they register', () => {
    const board = new OfferBoard('robot');
    const robots = [robot(0), robot(1, { name: 'other' }), robot(2, { sdpOffer: null })];
    expect(idsOf(board.read({ type: 'robots', robots }))).toEqual([0]);
    expect(idsOf(board.read({ type: 'register', robot: robot(3) }))).toEqual([3]);
    expect(idsOf(board.read({ type: 'register', robot: robot(4, { name: 'other' }) }))).toEqual([]);
  });

  it('ignores a registration listed beside an open one whose own offer was answered', () => {
    const board = new OfferBoard('robot');
    expect(
      idsOf(board.read({ type: 'robots', robots: [robot(0, { sdpAnswer: 'answer' }), robot(1)] })),
    ).toEqual([1]);
    const answered = [robot(0, { sdpAnswer: 'answer' }), robot(1, { sdpAnswer: 'answer' })];
    expect(idsOf(board.read({ type: 'robots', robots: answered }))).toEqual([1]);
  });

  it('answers the next offer of a robot that it knows', () => {
    const board = new OfferBoard('robot');
    expect(board.read({ type: 'offer', robotId: 0, sdpOffer: 'again' })).toEqual([]);
    board.read({ type: 'robots', robots: [robot(0)] });
    expect(board.read({ type: 'offer', robotId: 0, sdpOffer: 'again' })).toEqual([
      { robotId: 0, sdpOffer: 'again', candidates: [] },
    ]);
  });
});
