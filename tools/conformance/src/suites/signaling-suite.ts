import { readFileSync } from 'node:fs';
import { type Exchange, playExchange } from '../exchange.ts';
import { SocketPeer } from '../peers/socket-peer.ts';
import type { ConformanceCase } from './suite.ts';

/** A service's two ports. */
export interface SignalingTarget {
  robot: string;
  client: string;
}

const { exchanges } = JSON.parse(
  readFileSync(new URL('../../vectors/signaling.json', import.meta.url), 'utf8'),
) as { exchanges: [Exchange, ...Exchange[]] };

export const signalingSuite: readonly ConformanceCase<SignalingTarget>[] = [
  {
    name: 'robot 0, if the service has assigned no id yet, is a robot like any other',
    run: (target) => playExchange(exchanges[0], target),
    defect: 'robot-0-dropped',
  },
  ...exchanges.map(
    (exchange): ConformanceCase<SignalingTarget> => ({
      name: exchange.name,
      run: async (target, level) => {
        if (level === 'reference') await takeAnId(target);
        await playExchange(exchange, target);
      },
      defect: exchange.defect,
      deadly: exchange.deadly,
    }),
  ),
];

/** Takes an id, so that no exchange is affected by the defects of robot 0. */
async function takeAnId(target: SignalingTarget): Promise<void> {
  const socket = await SocketPeer.open(target.robot);
  socket.send({ type: 'register', name: 'conformance', sdpOffer: 'v=0' });
  await socket.message({ type: 'registered' });
  await socket.close();
}
