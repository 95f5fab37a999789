/** A broadcast to a Janus that is not on loopback: encrypted, and found again after an outage. */
import { writeFileSync } from 'node:fs';
import { networkInterfaces } from 'node:os';
import { join } from 'node:path';
import { findJanus, JANUS_REMEDY, JanusServer, LocalStack } from '@farpoint/local-stack';
import { eventually } from '@farpoint/service/testing/eventually';
import { useFolder } from '@farpoint/service/testing/folder';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { JanusViewer } from '../../testing/janus-viewer.ts';
import { metricOf } from '../../testing/metric-of.ts';

const address = Object.values(networkInterfaces())
  .flat()
  .find((own) => own?.family === 'IPv4' && !own.internal)?.address;

describe.skipIf(findJanus() === null || address === undefined)(
  `encrypted broadcast through Janus (needs: ${JANUS_REMEDY}; a network)`,
  { timeout: 60_000 },
  () => {
    const folder = useFolder();
    let janus: JanusServer;
    let stack: LocalStack;
    beforeAll(async () => {
      janus = await JanusServer.start({ host: address as string });
      const config = join(folder, 'farpoint.yaml');
      const broadcast = { janus: janus.url, adminKey: janus.adminKey };
      const signaling = { plaintextToken: true };
      writeFileSync(config, JSON.stringify({ robot: { broadcast, signaling } }));
      const args = ['--config', config, '--sim-size', '64', '--sim-lidars', '0'];
      stack = await LocalStack.start({ robots: [{ id: 'sim-1', name: 'Rover', args }] });
    }, 60_000);
    afterAll(async () => {
      await stack?.stop();
      await janus?.stop();
    }, 30_000);

    async function seeClouds(): Promise<void> {
      const sees = async (): Promise<boolean> => {
        const viewer = await JanusViewer.watch({ url: janus.url, mountpoint: 1 }).catch(() => null);
        if (viewer === null) return false;
        await viewer.until(() => viewer.clouds.size > 20 || viewer.ended !== null);
        const { ended, malformedPackets } = viewer;
        await viewer.close();
        expect(malformedPackets).toBe(0);
        return ended === null;
      };
      await eventually(sees);
    }

    const metric = (name: string) =>
      metricOf(stack.robotAdminUrl('sim-1'), `farpoint_robot_broadcast_${name}`);

    it('carries clouds', seeClouds);

    it('is found again, without another mountpoint, when Janus was out of reach', async () => {
      process.kill(janus.pid, 'SIGSTOP');
      try {
        await eventually(async () => (await metric('up')) !== 1);
      } finally {
        process.kill(janus.pid, 'SIGCONT');
      }
      await eventually(async () => (await metric('up')) !== 0);
      await seeClouds();
      expect(await metric('mountpoints_total')).toBe(1);
    });
  },
);
