import { LocalStack } from '@farpoint/local-stack';
import { afterAll, afterEach, beforeAll } from 'vitest';
import type { OperatorClientOptions } from './operator-client.ts';
import { SignaledOperator } from './signaled-operator.ts';

/** A robot under test, with the real signaling service. */
export interface RobotUnderTest {
  readonly stack: LocalStack;
  /** An operator of it, closed after the test. */
  connect(options?: OperatorClientOptions): Promise<SignaledOperator>;
  /** Closes this operator after the test. */
  keep(operator: SignaledOperator): SignaledOperator;
}

/** Starts a robot process before a file's tests and stops it after them. Call it at the top of the file. */
export function useRobot(
  id: string,
  args: readonly string[],
  signalingArgs: readonly string[] = [],
): RobotUnderTest {
  let stack: LocalStack | null = null;
  const operators: SignaledOperator[] = [];
  const keep = (operator: SignaledOperator) => {
    operators.push(operator);
    return operator;
  };
  const running = () => {
    if (stack === null) throw new Error('the robot runs within tests and hooks only');
    return stack;
  };
  beforeAll(async () => {
    stack = await LocalStack.start({
      signalingArgs: [...signalingArgs],
      robots: [{ id, name: 'Simulated robot', args: [...args] }],
    });
  }, 60_000);
  afterAll(async () => {
    await stack?.stop();
  }, 30_000);
  afterEach(async () => {
    await Promise.all(operators.splice(0).map((operator) => operator.close()));
  });
  return {
    get stack() {
      return running();
    },
    async connect(options) {
      return keep(await SignaledOperator.connect(running().signalingUrl, id, options));
    },
    keep,
  };
}
