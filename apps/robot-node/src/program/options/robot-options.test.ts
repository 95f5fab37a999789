import { OptionsError } from '@farpoint/service';
import { describe, expect, it } from 'vitest';
import { robotOf } from './testing/robot-of.ts';

const robot = (...argv: string[]) => robotOf(argv);
const file = (text: string) => robotOf([], text);

describe('robot options', () => {
  it('make a simulated robot by default', () => {
    const options = robot();
    expect(options.sensors[0]?.capture).toMatchObject({
      source: { kind: 'sim', seed: 1, size: 480 },
      framesPerSecond: 60,
    });
    expect(options).toMatchObject({
      bitsPerSecond: 60e6,
      rateControl: 'adaptive',
      limits: { watchdogMs: 150 },
      places: { most: 4, perSubject: 2, keepMs: 30_000 },
    });
    expect(options.signaling.key).not.toBe(robot().signaling.key);
  });

  it('let a robot go sideways only where its limit says so, and the simulated one with it', () => {
    const options = robot();
    // Operators from before it read the limits.
    expect(Object.keys(options.limits)).not.toContain('maxLateral');
    expect(options.base?.maxLateral).toBe(0);
    expect(robot('--max-lateral', '0.4')).toMatchObject({
      limits: { maxLinear: 1, maxLateral: 0.4 },
      base: { maxLateral: 0.4 },
    });
    expect(() => robot('--max-lateral', '11')).toThrow('--max-lateral');
    expect(() => robot('--max-lateral', '-1')).toThrow('--max-lateral');
  });

  it('let the driver release STOP and demand an open hand after gaps, unless told otherwise', () => {
    expect(robot()).toMatchObject({ estopRelease: 'driver', afterGap: 'let-go' });
    expect(robot('--estop-release', 'latcher', '--after-gap', 'resume')).toMatchObject({
      ...{ estopRelease: 'latcher', afterGap: 'resume' },
    });
    // Nobody could ever release it.
    expect(() => robot('--estop-release', 'supervisor')).toThrow(/needs --grant-keys/);
  });

  it('take a recorded source', () => {
    const argv = ['--source', 'pcd', '--path', 'a.pcd', '--axes', 'body', '--fps', '10'];
    const [{ capture } = { capture: null }] = robot(...argv).sensors;
    expect(capture).toMatchObject({
      source: { kind: 'pcd', path: 'a.pcd', frame: 'body' },
      framesPerSecond: 10,
    });
  });

  it('name the base’s frame to ROS and to recordings', () => {
    const ROS = 'robot:\n  source: { kind: ros2 }\n  topics: [{ topic: /points, as: cloud }]\n';
    const named = file(`${ROS}  ros: { baseFrame: robot1/base_link }\n`);
    expect(named.sensors[0]?.capture.source).toMatchObject({ baseFrame: 'robot1/base_link' });
    const played = robot('--source', 'recording', '--path', 'a.mcap', '--ros-base-frame', '/body');
    expect(played.sensors[0]?.capture.source).toMatchObject({ baseFrame: '/body' });
    expect(file(ROS).sensors[0]?.capture.source).toMatchObject({ baseFrame: null });
    for (const name of [' ', 'a//b', 'a b'])
      expect(() => robot('--ros-base-frame', name)).toThrow('--ros-base-frame');
  });

  it('take a source and a sink in shared memory', () => {
    const options = robot(
      ...['--source', 'shm', '--shm-layout', 'reference', '--shm-folder', '/x', '--sink', 'shm'],
    );
    expect(options.sensors[0]?.capture).toMatchObject({
      source: { kind: 'shm', layout: 'reference', folder: '/x', waitMs: 10_000 },
      framesPerSecond: 30,
    });
    expect(options.sink).toEqual({
      kind: 'shm',
      folder: '/x',
      mode: 0o600,
      silenceMs: 150,
      readerRequired: false,
    });
    expect(robot('--sink', 'shm', '--shm-access', 'group').sink).toMatchObject({ mode: 0o660 });
    expect(robot().sink).toEqual({ kind: 'base' });
  });

  it('take servers by address, as JSON, and with credentials from the file', () => {
    const urls = 'turn:turn.example.org?transport=tcp';
    expect(robot('--ice-servers', `stun:a:3478, ${urls}`).iceServers).toEqual([
      { urls: 'stun:a:3478' },
      { urls },
    ]);
    const server = { urls: [urls], username: 'u', credential: 'c' };
    expect(robot('--ice-servers', JSON.stringify([server])).iceServers).toEqual([server]);
    expect(file(`robot: {network: {iceServers: ["stun:a", ${JSON.stringify(server)}]}}`).iceServers).toEqual([
      { urls: 'stun:a' },
      server,
    ]);
  });

  it('take everything from groups in the file, and name conflicting options by their lines', () => {
    expect(
      file('robot: {limits: {maxLinear: 0.2}, stream: {bitrateMbps: 20}, network: {udpPorts: 5-9}}'),
    ).toMatchObject({
      limits: { maxLinear: 0.2 },
      bitsPerSecond: 20e6,
      portRange: [5, 9],
    });
    const bad = 'robot:\n  signaling: {tlsCa: /nowhere.pem}\n  source:\n    kind: recording\n';
    expect(() => file(bad)).toThrow(
      /^--path \(or robot\.source\.path in farpoint\.yaml\) is needed for the source recording\nfarpoint\.yaml:2: robot\.signaling\.tlsCa cannot be read/,
    );
    expect(() => file('robot:\n  topics:\n    - {topic: points, as: cloud}\n')).toThrow(
      'farpoint.yaml:3: robot.topics.0.topic must be a complete topic name such as /camera/points, not "points"',
    );
  });

  it('take pictures and readings of a recording from the topic table, but no pictures of other files', () => {
    const topics = '[{topic: /front, as: picture}, {topic: /diagnostics, as: diagnostics}]';
    const recording = `robot: {source: {kind: recording, path: a.mcap}, topics: ${topics}}`;
    expect(file(recording).sensors[0]?.capture.source).toMatchObject({
      ...{ kind: 'recording', path: 'a.mcap' },
      topics: [
        { topic: '/front', as: 'picture' },
        { topic: '/diagnostics', as: 'diagnostics' },
      ],
    });
    expect(() => file(`robot: {source: {kind: pcd, path: a.pcd}, topics: ${topics}}`)).toThrow(
      /topics .*can have `as: picture` only with the source ros1, ros2 or recording/,
    );
  });

  it('hide credentials in errors', () => {
    expect(() => robot('--ice-servers', '[{"urls":"turn:a","credential":5,"secret":"x"}]')).toThrow(
      /^--ice-servers\.0\.\w+ .*text$/m,
    );
  });

  it.each([
    [['--source', 'pcd'], '--path'],
    [['--sim-size', '479'], '--sim-size'],
    [['--signaling', 'http://x'], '--signaling'],
    [['--udp-ports', '5-4'], '--udp-ports'],
    [['--tls-ca', '/nowhere.pem'], '--tls-ca'],
    [['--id', 'Not Ok'], '--id'],
    [['--watchdog-ms', '100000'], '--watchdog-ms'],
    [['--ice-servers', 'http://x'], '--ice-servers'],
  ])('refuse %j, naming %s', (argv, where) => {
    expect(() => robot(...argv)).toThrow(OptionsError);
    expect(() => robot(...argv)).toThrow(where);
  });

  describe('cameras with video', () => {
    const video = (source: string, head = '') =>
      file(`robot:\n${head}  videos:\n    - { name: Front, source: ${source} }\n`);
    const mistakeOf = (source: string, head = '') => {
      try {
        video(source, head);
      } catch (error) {
        if (error instanceof OptionsError) return error.message;
        throw error;
      }
      throw new Error('it was accepted');
    };
    const ROS1 = '  source: { kind: ros1 }\n  topics: [{ topic: /points, as: cloud }]\n';

    it('from ROS join the graph of the source, or the one that they name', () => {
      const [{ source } = { source: null }] = video('{ kind: ros, topic: /front/image }', ROS1).videos;
      expect(source).toMatchObject({
        kind: 'ros',
        graph: { kind: 'ros1', name: expect.stringContaining('farpoint_') as string },
        entry: { topic: '/front/image', type: 'sensor_msgs/msg/Image', as: 'picture', most: null },
      });
      const [two] = video(
        '{ kind: ros, topic: /x/compressed, ros: 2, qos: { reliability: reliable } }',
        ROS1,
      ).videos;
      expect(two?.source).toMatchObject({
        graph: { kind: 'ros2' },
        entry: { type: 'sensor_msgs/msg/CompressedImage', qos: { reliability: 'reliable' } },
      });
      const [typed] = video('{ kind: ros, topic: /x, ros: 1, type: sensor_msgs/CompressedImage }').videos;
      expect(typed?.source).toMatchObject({ entry: { type: 'sensor_msgs/msg/CompressedImage' } });
    });

    it('of the simulator have their place on the robot, and each a seed of its own', () => {
      const { videos } = file(
        'robot:\n  videos:\n    - { name: A, source: { kind: sim } }\n    - { name: B, source: { kind: sim, left: 0.2, yaw: 1.5 } }\n',
      );
      expect(videos[0]?.source).toMatchObject({
        framesPerS: 30,
        camera: { width: 640, height: 480, left: 0, yaw: 0 },
      });
      expect(videos[1]?.source).toMatchObject({ camera: { left: 0.2, yaw: 1.5 } });
      const seeds = videos.map(({ source }) => source.kind === 'sim' && source.seed);
      expect(new Set(seeds).size).toBe(2);
    });

    it('of the cloud’s own camera trigger the simulated clouds', () => {
      const ofCloud = '{ name: Depth, ofCloud: true, source: { kind: sim, width: 480, height: 480 } }';
      const { videos, sensors } = file(`robot:\n  videos: [${ofCloud}]\n`);
      expect(videos).toMatchObject([{ ofCloud: true }]);
      expect(sensors[0]?.capture.source).toMatchObject({ kind: 'sim', triggerPerS: 30 });
      expect(file('robot:\n  videos: []\n').sensors[0]?.capture.source).toMatchObject({
        triggerPerS: undefined,
      });
    });

    it('that are triggered trigger the simulated clouds, too, at the clouds’ own rate', () => {
      const triggerOf = (source: string) => {
        const { sensors } = file(
          `robot:\n  source: { fps: 10 }\n  videos: [{ name: Front, source: ${source} }]\n`,
        );
        const [main] = sensors;
        return main?.capture.source.kind === 'sim' ? main.capture.source.triggerPerS : null;
      };
      expect(triggerOf('{ kind: sim }')).toBe(10);
      expect(triggerOf('{ kind: test }')).toBe(10);
      expect(triggerOf('{ kind: rtsp, url: rtsp://127.0.0.1/front }')).toBe(undefined);
    });

    it.each([
      ['source: { kind: sim }', /only at the simulated depth camera’s place/],
      ['source: { kind: sim, width: 480, height: 480, yaw: 0.1 }', /only at the simulated depth camera’s/],
      [
        'framesPerS: 15, source: { kind: sim, width: 64, height: 64 }',
        /needs equal `framesPerS` of camera 1/,
      ],
      ['ofCloud: 1, source: { kind: test }', /ofCloud.*must be true or false/],
      ['source: { kind: test } }, { name: B, ofCloud: true, source: { kind: test }', /at most one camera/],
    ])('of the cloud’s own camera are refused with a clear sentence: %s', (camera, words) => {
      const ofCloud = camera.startsWith('ofCloud') ? '' : 'ofCloud: true, ';
      const read = () => file(`robot:\n  videos: [{ name: A, ${ofCloud}${camera} }]\n`);
      expect(read).toThrow(words);
    });

    it.each([
      [
        '{ kind: ros, topic: /x }',
        '',
        /needs `ros: 1` or `ros: 2` for camera 1: neither source nor sink is ROS/,
      ],
      ['{ kind: ros, topic: image, ros: 2 }', '', /topic.*must be a complete topic name such as/],
      ['{ kind: ros, ros: 2 }', '', /topic.*must be a topic name/],
      ['{ kind: ros, topic: /x, ros: 3 }', '', /ros.*must be 1 or 2/],
      [
        '{ kind: ros, topic: /x, ros: 2, type: std_msgs/String }',
        '',
        /type.*must be sensor_msgs\/msg\/Image or/,
      ],
      ['{ kind: ros, topic: /x/compressedDepth, ros: 2 }', '', /cannot be shown as compressedDepth/],
      ['{ kind: sim, width: 642 }', '', /width.*must be a multiple of 4/],
      ['{ kind: sim, framesPerS: 1000 }', '', /framesPerS.*must be at most 120/],
      ['{ kind: sim, framesPerS: 0 }', '', /framesPerS.*must be at least 1/],
      ['{ kind: sim }', ROS1, /can have a camera of the kind sim \(camera 1\) only with the source sim/],
      ['{ kind: test, framesPerS: 100000 }', '', /framesPerS.*must be at most 240/],
      ['{ kind: test, framesPerS: .nan }', '', /framesPerS.*must be a number/],
      ['{ kind: frames }', '', /must be one of|Invalid input|kind/],
    ] as const)('are refused with a clear sentence: %s', (source, head, words) => {
      expect(mistakeOf(source, head)).toMatch(words);
    });
  });
});
