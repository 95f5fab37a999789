import { longProperty } from '@farpoint/network-sim/cases';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { fromDdsTopic, fromDdsType, toDdsService, toDdsTopic, toDdsType } from './ros-names.ts';

/** Any code points. `fc.string` with the unit `binary` takes seconds to begin. */
const anyText = fc
  .array(fc.nat(0x10ffff), { maxLength: 300 })
  .map((codes) => String.fromCodePoint(...codes).toWellFormed());

describe('names of topics', () => {
  it.each([
    ['/cmd_vel', 'rt/cmd_vel'],
    ['/robot1/camera/depth/points', 'rt/robot1/camera/depth/points'],
  ])('%s is %s', (topic, name) => {
    expect(toDdsTopic(topic)).toBe(name);
    expect(fromDdsTopic(name)).toBe(topic);
  });

  it.each(['cmd_vel', '/', '', '/a//b', '/a/', '/1a', '/a b', '/a\0', '/ä', `/${'a'.repeat(253)}`])(
    '%j is not a fully qualified topic name',
    (topic) => {
      expect(toDdsTopic(topic)).toBeNull();
    },
  );

  it.each([
    'rq/add_two_intsRequest',
    'rr/add_two_intsReply',
    'ros_discovery_info',
    'DCPSTopic',
    'rt',
    'rt/',
    'rtx/a',
  ])('%s is no ROS topic', (name) => {
    expect(fromDdsTopic(name)).toBeNull();
  });
});

describe('names of types', () => {
  it.each([
    ['geometry_msgs/msg/Twist', 'geometry_msgs::msg::dds_::Twist_'],
    ['sensor_msgs/msg/PointCloud2', 'sensor_msgs::msg::dds_::PointCloud2_'],
    ['tf2_msgs/msg/TFMessage', 'tf2_msgs::msg::dds_::TFMessage_'],
  ])('%s is %s', (type, name) => {
    expect(toDdsType(type)).toBe(name);
    expect(fromDdsType(name)).toBe(type);
  });

  it.each([
    'geometry_msgs/Twist',
    'Twist',
    'a/msg/b/c',
    'a::msg::b',
    '',
    'a/msg/',
    'a/mesg/B',
    `a/msg/${'B'.repeat(300)}`,
  ])('%s is no type', (type) => {
    expect(toDdsType(type)).toBeNull();
  });

  it.each(['HelloWorld', 'a::msg::B_', 'a::msg::dds_::B', 'a::msg::dds_::_', 'DDS::String'])(
    '%s is no ROS type',
    (name) => {
      expect(fromDdsType(name)).toBeNull();
    },
  );
});

it('any name either survives a round trip or is refused', () => {
  fc.assert(
    fc.property(anyText, (text) => {
      const [topic, type] = [toDdsTopic(text), toDdsType(text)];
      if (topic !== null) expect(fromDdsTopic(topic)).toBe(text);
      if (type !== null) expect(fromDdsType(type)).toBe(text);
      const [back, kind] = [fromDdsTopic(text), fromDdsType(text)];
      if (back !== null) expect(toDdsTopic(back)).toBe(text);
      if (kind !== null) expect(toDdsType(kind)).toBe(text);
    }),
    longProperty(1, 100),
  );
});

describe('services', () => {
  it('are two topics, also below an action', () => {
    expect(toDdsService('/charge')).toEqual({ request: 'rq/chargeRequest', reply: 'rr/chargeReply' });
    expect(toDdsService('/dock/_action/send_goal')).toEqual({
      request: 'rq/dock/_action/send_goalRequest',
      reply: 'rr/dock/_action/send_goalReply',
    });
    expect(toDdsType('robot_msgs/action/Dock_SendGoal_Request')).toBe(
      'robot_msgs::action::dds_::Dock_SendGoal_Request_',
    );
  });

  it.each(['charge', '/', '/charge/', '/a//b', '/1', `/${'a'.repeat(250)}`])('%s is none', (name) => {
    expect(toDdsService(name)).toBeNull();
  });
});
