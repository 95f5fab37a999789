import type { ServiceToRobot } from '@farpoint/protocol';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { RobotCounters } from '../../ground/robot-counters.ts';
import type { OperatorSession } from './operator-session.ts';
import {
  OperatorSessions,
  type OperatorSessionsEvents,
  type OperatorSessionsOptions,
} from './operator-sessions.ts';

const SESSION = 'session-1';
type Reason = Extract<ServiceToRobot, { type: 'session.closed' }>['reason'];

const left = vi.fn();
const close = vi.fn();
beforeEach(() => vi.clearAllMocks());

/** @param connected whether the operator's connection is there; `null`: its end came first, so that nobody is known */
function closed(reason: Reason, connected: boolean | null): void {
  const host = { drive: { guard: { estopState: () => ({ latched: false }) } } };
  const commands = { commands: [], recording: null };
  const options = { id: 'robot-1', grants: null, counters: new RobotCounters(), host, commands };
  const sessions = new OperatorSessions(
    options as unknown as OperatorSessionsOptions,
    { left } as unknown as OperatorSessionsEvents,
  );
  if (connected !== null)
    sessions.operators.set(SESSION, { peer: { connected, close } } as unknown as OperatorSession);
  sessions.onSignaling({ type: 'session.closed', session: SESSION, reason });
}

describe('a session that the service has closed', () => {
  it('is left by its driver on purpose, even if the end of its connection came first', () => {
    closed('closed-by-operator', null);
    expect(left.mock.calls).toEqual([[SESSION]]);
    expect(close).not.toHaveBeenCalled();
  });

  it('is not left on purpose if a signaling connection was lost', () => {
    for (const connected of [true, false, null]) closed('operator-left', connected);
    expect(left).not.toHaveBeenCalled();
  });

  it('ends its connection, but for a lost signaling connection beside a path that holds', () => {
    closed('closed-by-operator', true);
    closed('closed-by-operator', false);
    closed('operator-left', false);
    expect(close.mock.calls).toEqual([
      ['closed', 'closed-by-operator'],
      ['closed', 'closed-by-operator'],
      ['closed', 'operator-left'],
    ]);
    close.mockClear();
    closed('operator-left', true);
    expect(close).not.toHaveBeenCalled();
  });
});
