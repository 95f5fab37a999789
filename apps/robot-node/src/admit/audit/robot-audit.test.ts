import type { AuditEvent } from '@farpoint/audit';
import { expect, it } from 'vitest';
import { type Access, openAccess } from '../access/access.ts';
import { RobotAudit } from './robot-audit.ts';

const setUp = () => {
  const events: AuditEvent[] = [];
  const audit = new RobotAudit({ record: (event) => events.push(event) });
  return { audit, events, kinds: () => events.map(({ kind }) => kind) };
};
const grant: Access = {
  role: 'drive',
  subject: 'ada',
  grant: { id: 'g1', subject: 'ada', keyId: 'k1', issuedAtS: 0 },
  name: 'Ada',
  expiresAtS: 2000,
  keyId: 'k1',
};
const ada = { id: 'handle-of-ada', access: grant };
const bob = { id: 'handle-of-bob', access: openAccess('Bob') };

it('names the grant’s subject, role and id; without a grant, a name that nothing proves', () => {
  const { audit, events } = setUp();
  audit.sessionBegan(ada);
  audit.sessionBegan(bob);
  expect(events).toEqual([
    {
      ...{ kind: 'session-began', session: expect.stringMatching(/^[0-9a-f]{12}$/) },
      subject: { id: 'ada', name: 'Ada', role: 'drive', grant: 'g1', proven: true },
      details: { keyId: 'k1', expiresAtS: 2000 },
    },
    {
      ...{ kind: 'session-began', session: expect.stringMatching(/^[0-9a-f]{12}$/) },
      subject: { name: 'Bob', proven: false },
      details: {},
    },
  ]);
  expect(JSON.stringify(events)).not.toContain('handle');
});

it('says that a lease was given, taken, released or has expired, and to whom', () => {
  const { audit, events, kinds } = setUp();
  audit.driver(ada.id, ada);
  // Asking again, and a lease that nobody has.
  audit.driver(ada.id, ada);
  audit.driver(bob.id, bob);
  audit.driver(null, undefined);
  audit.driver(null, undefined, 'expired');
  audit.driver(ada.id, ada);
  audit.driver(null, undefined, 'expired');
  audit.driver('reference-7', undefined);
  audit.driver(null, undefined, 'session-ended');
  expect(kinds()).toEqual([
    ...['lease-given', 'lease-taken', 'lease-released', 'lease-given', 'lease-expired', 'lease-given'],
    'lease-released',
  ]);
  expect(events[1]).toMatchObject({
    subject: { name: 'Bob' },
    details: { from: { id: 'ada', name: 'Ada' } },
  });
  expect(events[2]).toMatchObject({ subject: { name: 'Bob' }, details: { because: 'asked' } });
  expect(events[4]).toMatchObject({ subject: { id: 'ada' }, details: { because: 'expired' } });
  expect(events[6]).toMatchObject({
    subject: { name: 'an operator of the reference system', proven: false },
    details: { because: 'session-ended' },
  });
});

it('records the end of sessions that began, and of no others', () => {
  const { audit, events } = setUp();
  audit.sessionEnded(ada, 'not-connected', 'no path');
  audit.sessionBegan(ada);
  audit.sessionEnded(ada, 'silent', 'nothing heard');
  audit.sessionEnded(ada, 'silent', 'nothing heard');
  expect(events.slice(1)).toMatchObject([
    { kind: 'session-ended', subject: { id: 'ada' }, details: { reason: 'silent', detail: 'nothing heard' } },
  ]);
});

it('tells every log', () => {
  const { audit, kinds } = setUp();
  const more: AuditEvent[] = [];
  audit.refused('lease', 'held', ada);
  audit.alsoTell({ record: (event) => more.push(event) });
  audit.refused('command', 'not-permitted', ada);
  expect(kinds()).toEqual(['refused', 'refused']);
  expect(more).toMatchObject([
    { subject: { id: 'ada' }, details: { what: 'command', reason: 'not-permitted' } },
  ]);
});

it('says who latched and released the emergency stop', () => {
  const { audit, events } = setUp();
  audit.startsLatched('unclean-exit');
  audit.estop({ type: 'estop', latched: false }, ada);
  audit.estop({ type: 'estop', latched: true, by: 'operator' }, bob);
  audit.estop({ type: 'estop', latched: true, by: 'robot' }, undefined);
  expect(events).toMatchObject([
    { kind: 'estop-latched', details: { by: 'robot', atStart: 'unclean-exit' } },
    { kind: 'estop-released', subject: { id: 'ada' } },
    { kind: 'estop-latched', subject: { name: 'Bob', proven: false }, details: { by: 'operator' } },
    { kind: 'estop-latched', details: { by: 'robot' } },
  ]);
  expect(events[3]).not.toHaveProperty('subject');
});
