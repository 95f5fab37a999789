import { freePorts, hasTurnServer, TURN_REMEDY, TurnServer } from '@farpoint/local-stack';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

test('through a TURN relay only: points and commands arrive, and a restarted relay is found again', async ({
  page,
  startStack,
}) => {
  test.skip(!hasTurnServer(), `no turnserver here: ${TURN_REMEDY}`);
  const turn = new TurnServer((await freePorts(1))[0] as number);
  await turn.start();
  try {
    const stack = await startStack({
      signalingArgs: ['--turn-urls', turn.url, '--turn-secret', turn.secret],
      robots: [
        {
          ...simulatedRobot,
          args: [...simulatedRobot.args, '--ice-policy', 'relay', '--bitrate-mbps', '6'],
        },
      ],
    });
    const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id, ice: 'relay' });
    await operator.expectPoints();
    const start = await operator.body();
    await operator.holdForward();
    await operator.expectMovedFrom(start, 0.3);
    await operator.release();
    await operator.expectStanding();

    // There is no other path, and the relay has forgotten both peers.
    await turn.stop();
    await expect.poll(async () => (await operator.state()).link).toContain('Connection lost');
    await turn.start();
    await operator.expectFrames(5);
    const stood = await operator.body();
    await operator.holdForward();
    await operator.expectMovedFrom(stood, 0.1);
    await operator.release();
    expect((await operator.state()).sessionsOpened).toBe(1);
  } finally {
    await turn.stop();
  }
});
