import { describe, expect, it } from 'vitest';
import { RosFault } from '../fault.ts';
import { chooseRos2Graph, isSourced, rclEnvironment } from './environment.ts';

const there = { sourced: true, installed: true, needsDds: false };

describe('which graph', () => {
  it.each([
    ['auto', {}, 'rclnodejs'],
    ['auto', { sourced: false }, 'dds'],
    ['auto', { installed: false }, 'dds'],
    ['auto', { needsDds: true }, 'dds'],
    ['dds', {}, 'dds'],
    ['rclnodejs', {}, 'rclnodejs'],
  ] as const)('%s with %j: %s', (asked, missing, graph) => {
    expect(chooseRos2Graph(asked, { ...there, ...missing })).toBe(graph);
  });

  it.each([
    [{ sourced: false, installed: false }, 'no ROS 2 installation is sourced'],
    [{ installed: false }, 'rclnodejs is not installed'],
    [{ needsDds: true }, 'rclnodejs cannot be given a network interface'],
  ])('reports a one-sentence fault for a choice by name with %j', (missing, what) => {
    const choose = () => chooseRos2Graph('rclnodejs', { ...there, ...missing });
    expect(choose).toThrow(RosFault);
    expect(choose).toThrow(
      expect.objectContaining({
        code: 'unavailable',
        what: expect.stringContaining(what) as string,
        remedy: expect.stringContaining('ros.graph: dds') as string,
      }),
    );
  });
});

it('ROS is sourced if both of its variables are set', () => {
  expect(isSourced({ AMENT_PREFIX_PATH: '/opt/ros/jazzy', ROS_DISTRO: 'jazzy' })).toBe(true);
  expect(isSourced({ AMENT_PREFIX_PATH: '', ROS_DISTRO: 'jazzy' })).toBe(false);
  expect(isSourced({ AMENT_PREFIX_PATH: '/opt/ros/jazzy' })).toBe(false);
});

describe('the environment of its process', () => {
  it('is what ROS needs of ours, without systemd’s variables and secrets', () => {
    const env = {
      PATH: '/bin',
      ROS_DOMAIN_ID: '3',
      NOTIFY_SOCKET: '/n',
      WATCHDOG_USEC: '1',
      WATCHDOG_PID: '2',
      FARPOINT_ROBOT_TOKEN: 'hunter2',
      AWS_SECRET_ACCESS_KEY: 'hunter2',
      ROS_TOKEN: 'hunter2',
    };
    expect(rclEnvironment({}, env)).toEqual({ PATH: '/bin', ROS_DOMAIN_ID: '3' });
  });

  it('options take precedence over ROS’s variables', () => {
    const env = { ROS_DISTRO: 'jazzy', ROS_DOMAIN_ID: '3', ROS_STATIC_PEERS: 'x' };
    expect(rclEnvironment({ domain: 0, peers: ['a', 'b'], localhostOnly: true }, env)).toEqual({
      ROS_DISTRO: 'jazzy',
      ROS_DOMAIN_ID: '0',
      ROS_STATIC_PEERS: 'a;b',
      ROS_AUTOMATIC_DISCOVERY_RANGE: 'LOCALHOST',
    });
    expect(rclEnvironment({ localhostOnly: false }, { ROS_DISTRO: 'humble' })).toMatchObject({
      ROS_LOCALHOST_ONLY: '0',
    });
  });
});
