import type { ModelLink, ModelShape } from '@farpoint/protocol';
import { thrown } from '@farpoint/service/testing/thrown';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type RobotModel, readUrdf } from './read-urdf.ts';
import { UrdfFault, type UrdfFaultCode } from './urdf-fault.ts';

const robot = (inner: string) => `<?xml version="1.0"?>\n<robot name="r">${inner}</robot>`;
const joint = (name: string, type: string, parent: string, child: string, inner = '') =>
  `<joint name="${name}" type="${type}"><parent link="${parent}"/><child link="${child}"/>${inner}</joint>`;
const visual = (geometry: string, inner = '') => `<visual>${inner}<geometry>${geometry}</geometry></visual>`;
const HALF = Number(Math.SQRT1_2.toFixed(4));
const ball = visual('<sphere radius="0.1"/>');
const linksOf = ({ parts }: RobotModel) => parts.filter((part): part is ModelLink => part.part === 'link');
const shapesOf = ({ parts }: RobotModel) => parts.filter((part): part is ModelShape => part.part === 'shape');

describe('a description', () => {
  it('gives moving links and shapes; links that do not move against each other are one', () => {
    const model = readUrdf(
      robot(`
        <material name="red"><color rgba="1 0 0 1"/></material>
        <link name="base_link">${visual('<box size="0.4 0.3 0.1"/>', '<origin xyz="0 0 0.1"/>')}</link>
        <link name="mast">${visual('<cylinder radius="0.02" length="0.5"/>', '<material name="red"/>')}</link>
        <link name="wheel">${ball}</link>
        <link name="cap">${ball}</link>
        ${joint('m', 'fixed', 'base_link', 'mast', '<origin xyz="0.1 0 0.3"/>')}
        ${joint('w', 'continuous', 'mast', 'wheel', '<origin xyz="0 0.2 0"/><axis xyz="0 2 0"/>')}
        ${joint('c', 'fixed', 'wheel', 'cap', '<origin xyz="0 0.05 0"/>')}`),
    );
    expect(linksOf(model)).toEqual([
      { part: 'link', parent: 0, place: [0.1, 0.2, 0.3, 0, 0, 0, 1], moves: 'turns', axis: [0, 1, 0] },
    ]);
    expect(
      shapesOf(model).map(({ link, form, place, size, colour }) => [
        link,
        form,
        place.slice(0, 3),
        size,
        colour,
      ]),
    ).toEqual([
      [0, 'box', [0, 0, 0.1], [0.4, 0.3, 0.1], 0x9aa7b4],
      [0, 'cylinder', [0.1, 0, 0.3], [0.02, 0.5], 0xff0000],
      [1, 'sphere', [0, 0, 0], [0.1], 0x9aa7b4],
      [1, 'sphere', [0, 0.05, 0], [0.1], 0x9aa7b4],
    ]);
    expect(model.joints).toEqual([{ name: 'w', moves: 'turns', multiplier: 1, offset: 0 }]);
  });

  it('is placed in base_link, whatever its root is', () => {
    const model = readUrdf(
      robot(`<link name="base_footprint">${ball}</link><link name="base_link">${ball}</link>
        ${joint('j', 'fixed', 'base_footprint', 'base_link', '<origin xyz="0 0 0.2" rpy="0 0 1.5707963"/>')}`),
    );
    expect(shapesOf(model).map(({ place }) => place)).toEqual([
      [0, 0, -0.2, 0, 0, -HALF, HALF],
      [0, 0, 0, 0, 0, 0, 1],
    ]);
  });

  it.each(['body', '/body', 'robot1/body'])('is placed in the base that is named: %s', (base) => {
    const model = readUrdf(
      robot(`<link name="base_link">${ball}</link><link name="body">${ball}</link>
        ${joint('j', 'fixed', 'base_link', 'body', '<origin xyz="0 0 0.2"/>')}`),
      base,
    );
    expect(shapesOf(model).map(({ place }) => place[2])).toEqual([-0.2, 0]);
  });

  it('turns by roll, pitch and yaw about fixed axes, in this order', () => {
    const model = readUrdf(
      robot(`<link name="a"/><link name="b">${visual('<box size="1 1 1"/>', '<origin xyz="1 0 0"/>')}</link>
        ${joint('j', 'fixed', 'a', 'b', '<origin rpy="1.5707963 0 1.5707963"/>')}`),
    );
    expect(shapesOf(model)[0]?.place).toEqual([0, 1, 0, 0.5, 0.5, 0.5, 0.5]);
  });

  it('lets joints follow others, also over several', () => {
    const mimic = (of: string, more: string) => `<mimic joint="${of}" ${more}/>`;
    const { joints } = readUrdf(
      robot(`<link name="a"/><link name="b"/><link name="c"/><link name="d"/>
        ${joint('x', 'prismatic', 'a', 'b')}
        ${joint('y', 'revolute', 'a', 'c', mimic('x', 'multiplier="-2" offset="0.5"'))}
        ${joint('z', 'revolute', 'a', 'd', mimic('y', 'multiplier="3"'))}`),
    );
    expect(joints).toEqual([
      { name: 'x', moves: 'slides', multiplier: 1, offset: 0 },
      { name: 'x', moves: 'turns', multiplier: -2, offset: 0.5 },
      { name: 'x', moves: 'turns', multiplier: -6, offset: 1.5 },
    ]);
  });

  it('has the collision shapes of a link in place of its meshes, and says which meshes are missing', () => {
    const mesh = visual('<mesh filename="package://r/../../etc/passwd"/>', '<material name="x"/>');
    const solid = '<collision><geometry><box size="1 2 3"/></geometry></collision>';
    const model = readUrdf(
      robot(
        `<link name="a">${mesh}${solid}</link><link name="b">${mesh}${mesh}</link>${joint('j', 'fixed', 'a', 'b')}`,
      ),
    );
    expect(shapesOf(model).map(({ size }) => size)).toEqual([[1, 2, 3]]);
    expect(model.meshes).toEqual({ replaced: 1, missing: 2 });
  });

  it('leaves out what has no extent, and what cannot be seen', () => {
    const clear = '<material name="m"><color rgba="0 0 0 0"/></material>';
    const model = readUrdf(
      robot(
        `<link name="a">${visual('<box size="1 1 0"/>')}${visual('<sphere radius="1"/>', clear)}${ball}</link>`,
      ),
    );
    expect(shapesOf(model)).toHaveLength(1);
  });
});

describe('what other readers take is taken', () => {
  const pair = (inner: string) => robot(`<link name="a">${ball}</link><link name="b">${ball}</link>${inner}`);
  const one = (inner: string) => robot(`<link name="a">${inner}${ball}</link>`);
  const limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>';

  it.each([
    [
      'an axis without direction, of a fixed joint',
      pair(joint('x', 'fixed', 'a', 'b', '<axis xyz="0 0 0"/>')),
    ],
    ['one of a floating joint', pair(joint('x', 'floating', 'a', 'b', '<axis xyz="0 0 0"/>'))],
    ['one of a planar joint', pair(joint('x', 'planar', 'a', 'b', '<axis xyz="0 0 0"/>'))],
    ['an axis that is none, of a fixed joint', pair(joint('x', 'fixed', 'a', 'b', '<axis xyz="z"/>'))],
    [
      'an axis without direction, of a joint that turns',
      pair(joint('x', 'revolute', 'a', 'b', '<axis xyz="0 0 0"/>')),
    ],
    ['an empty origin', pair(joint('x', 'fixed', 'a', 'b', '<origin/>'))],
    ['many digits', pair(joint('x', 'fixed', 'a', 'b', '<origin xyz=" +1e-0003\t2.E+1\n-.5 "/>'))],
    ['a small number', pair(joint('x', 'fixed', 'a', 'b', '<origin xyz="1e-400 0 0"/>'))],
    ['many turns', pair(joint('x', 'fixed', 'a', 'b', '<origin rpy="5000 0 0"/>'))],
    ['a name like any text', robot(`<link name=" R&D &amp; &foo; a<b>ä/(%) ">${ball}</link>`)],
    ['no name', robot(`<link name="">${ball}</link>`)],
    ['a long name', robot(`<link name="${'x'.repeat(1000)}">${ball}</link>`)],
    ['attributes without blanks between', robot(`<link name="a"type="b">${ball}</link>`)],
    ['elements of others', `${one('<größe/><a:b:c/>')}<!-- -- -->`],
    ['a document type without definitions', `<!DOCTYPE robot>${one('')}`],
    ['an encoding', one('').replace('?>', ' encoding="ISO-8859-1" standalone="no"?>')],
    ['what xacro left behind', robot(`<xacro:property name="x" value="1"/><link name="a">${ball}</link>`)],
    [
      'what only other programs read',
      pair(`${joint('x', 'fixed', 'a', 'b', `${limit}<dynamics/><safety_controller k_velocity="1"/>`)}
        <gazebo reference="a"><link name="z"/></gazebo><transmission name="t"><joint name="z"/></transmission>`),
    ],
    [
      'many elements in one another',
      robot(`<link name="a">${ball}</link>${'<x>'.repeat(90)}${'</x>'.repeat(90)}`),
    ],
  ])('%s', (_, text) => {
    const model = readUrdf(text);
    expect(linksOf(model)).toEqual([]);
    expect(shapesOf(model).length).toBeGreaterThan(0);
  });

  it.each([
    ['NaN', '<box size="nan 1 1"/>'],
    ['infinity', '<box size="1e999 1 1"/>'],
    ['hexadecimal', '<sphere radius="0x10"/>'],
    ['huge', '<sphere radius="101"/>'],
    ['negative', '<cylinder radius="-1" length="1"/>'],
    ['too few numbers', '<box size="1 1"/>'],
    ['a length that is missing', '<cylinder radius="1"/>'],
    ['no geometry', ''],
  ])('a shape that is at fault is left out and counted, the others are drawn: %s', (_, geometry) => {
    const model = readUrdf(one(visual(geometry)));
    expect(shapesOf(model)).toHaveLength(1);
    expect(model.undrawn).toBe(1);
  });

  it('what is far away is left out and counted, with all that hangs on it', () => {
    const far = '<origin xyz="99 0 0"/>';
    const tree = `<link name="a">${ball}</link><link name="b"/><link name="c">${ball}</link><link name="d">${ball}</link>
      ${joint('x', 'fixed', 'a', 'b', far)}${joint('y', 'revolute', 'b', 'c', far)}${joint('z', 'revolute', 'c', 'd')}`;
    const model = readUrdf(robot(tree));
    expect(shapesOf(model)).toHaveLength(1);
    expect(model).toMatchObject({ undrawn: 2, joints: [] });
    expect(linksOf(model)).toEqual([]);
  });

  it('a joint that follows nothing, or itself, has the position that is told for itself', () => {
    const follows = (leader: string) =>
      joint('x', 'revolute', 'a', 'b', `<mimic joint="${leader}" multiplier="2"/>`);
    for (const leader of ['z', 'x'])
      expect(readUrdf(pair(follows(leader))).joints).toEqual([
        { name: 'x', moves: 'turns', multiplier: 1, offset: 0 },
      ]);
  });

  it('an axis without numbers is x, and joints keep their names as they are', () => {
    const model = readUrdf(pair(joint(' x ', 'continuous', 'a', 'b', '<axis/>')));
    expect(linksOf(model)).toMatchObject([{ axis: [1, 0, 0] }]);
    expect(model.joints).toMatchObject([{ name: ' x ' }]);
  });

  it('a material counts wherever it is defined; one that is at fault is as none', () => {
    const named = (rest: string) => `<material name="red">${rest}</material>`;
    const [red, bad] = ['<color rgba="1 0 0 1"/>', '<color rgba="1,0,0,1"/>'];
    const ofShapes = (first: string, second: string, global = '') =>
      shapesOf(
        readUrdf(
          robot(
            `<link name="a">${visual('<sphere radius="1"/>', first)}${visual('<sphere radius="1"/>', second)}</link>${global}`,
          ),
        ),
      ).map(({ colour }) => colour);
    expect(ofShapes(named(''), named(red))).toEqual([0xff0000, 0xff0000]);
    expect(ofShapes(named(''), named(''), named(red))).toEqual([0xff0000, 0xff0000]);
    expect(ofShapes(named(bad), '<material/>')).toEqual([0x9aa7b4, 0x9aa7b4]);
  });

  it('a capsule is drawn as the cylinder around it; a quaternion turns as roll, pitch and yaw do', () => {
    const turned = '<origin quat_xyzw="0 0 2 2"/>';
    const model = readUrdf(
      robot(`<link name="a">${visual('<capsule radius="0.5" length="2"/>', turned)}</link>`),
    );
    expect(shapesOf(model)).toMatchObject([
      { form: 'cylinder', size: [0.5, 3], place: [0, 0, 0, 0, 0, HALF, HALF] },
    ]);
  });
});

describe('hostile text is refused with what is wrong', () => {
  const nested = (depth: number) => `${'<a>'.repeat(depth)}${'</a>'.repeat(depth)}`;
  const chain = (count: number, type: string) =>
    Array.from({ length: count }, (_, i) => `<link name="l${i}"/>`).join('') +
    Array.from({ length: count - 1 }, (_, i) => joint(`j${i}`, type, `l${i}`, `l${i + 1}`)).join('');
  const one = (inner: string) => robot(`<link name="a">${inner}</link>`);
  const pair = (inner: string) => robot(`<link name="a"/><link name="b"/>${inner}`);

  it.each<[string, string, UrdfFaultCode]>([
    ['nothing', '', 'not-xml'],
    ['no XML', 'hello', 'not-xml'],
    ['not closed', '<robot>', 'not-xml'],
    ['crossed', '<robot><a></robot></a>', 'not-xml'],
    ['two roots', '<robot/><robot/>', 'not-xml'],
    ['a comment without end', '<robot><!-- </robot>', 'not-xml'],
    ['an attribute twice', '<robot a="1" a="2"/>', 'not-xml'],
    ['an unquoted attribute', '<robot a=1/>', 'not-xml'],
    [
      'entities that multiply',
      '<!DOCTYPE r [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;&a;">]><robot name="&b;"/>',
      'doctype',
    ],
    ['a file as an entity', '<!DOCTYPE r [<!ENTITY x SYSTEM "file:///etc/passwd">]><robot/>', 'doctype'],
    ['another root', '<sdf/>', 'not-urdf'],
    ['macros', robot('<xacro:include filename="x"/>'), 'xacro'],
    ['too long', robot(' '.repeat(1 << 20)), 'too-large'],
    ['too deep', robot(nested(501)), 'too-many'],
    ['too many elements', robot('<a/>'.repeat(20_001)), 'too-many'],
    [
      'too many attributes',
      `<robot ${Array.from({ length: 260 }, (_, i) => `a${i}="1"`).join(' ')}/>`,
      'too-many',
    ],
    ['too many moving links', robot(chain(140, 'revolute')), 'too-many'],
    ['too many links', robot(chain(2050, 'fixed')), 'too-many'],
    ['too many shapes', one(ball.repeat(513)), 'too-many'],
    ['no link', robot(''), 'not-a-tree'],
    ['two roots', pair(''), 'not-a-tree'],
    [
      'two parents',
      pair(`<link name="c"/>${joint('x', 'fixed', 'a', 'c')}${joint('y', 'fixed', 'b', 'c')}`),
      'not-a-tree',
    ],
    ['a ring', pair(joint('x', 'fixed', 'a', 'b') + joint('y', 'fixed', 'b', 'a')), 'not-a-tree'],
    [
      'a ring beside the root',
      pair(`<link name="c"/>${joint('x', 'fixed', 'b', 'c')}${joint('y', 'fixed', 'c', 'b')}`),
      'not-a-tree',
    ],
    ['a link that is its own parent', pair(joint('x', 'fixed', 'b', 'b')), 'not-a-tree'],
    ['a joint to nowhere', pair(joint('x', 'fixed', 'a', 'z')), 'unknown-name'],
    ['links of one name', robot('<link name="a"/><link name="a"/>'), 'bad-value'],
    ['an unknown joint', pair(joint('x', 'spring', 'a', 'b')), 'bad-value'],
    ['NaN', pair(joint('x', 'fixed', 'a', 'b', '<origin xyz="nan 0 0"/>')), 'bad-value'],
    ['infinity', pair(joint('x', 'fixed', 'a', 'b', '<origin xyz="1e999 0 0"/>')), 'bad-value'],
    ['hexadecimal', pair(joint('x', 'fixed', 'a', 'b', '<origin xyz="0x10 0 0"/>')), 'bad-value'],
    ['too few numbers', pair(joint('x', 'revolute', 'a', 'b', '<axis xyz="0 0"/>')), 'bad-value'],
    ['a joint like a prototype', pair(joint('x', 'toString', 'a', 'b')), 'bad-value'],
  ])('%s', (_, text, code) => {
    expect(thrown(UrdfFault, () => readUrdf(text)).code).toBe(code);
  });

  it('names the line', () => {
    expect(() => readUrdf('<robot>\n<link name="a"/>\n<link/></robot>')).toThrow(
      /^line 3: <link> has no name/,
    );
  });
});

describe('any text', () => {
  /** What is read can be told: places and sizes are bounded, and every link comes after its parent. */
  function check(text: string): void {
    let model: RobotModel;
    try {
      model = readUrdf(text);
    } catch (error) {
      expect(error).toBeInstanceOf(UrdfFault);
      return;
    }
    const links = linksOf(model);
    links.forEach(({ parent }, i) => {
      expect(parent).toBeLessThanOrEqual(i);
    });
    for (const { link, place, size } of shapesOf(model)) {
      expect(link).toBeLessThanOrEqual(links.length);
      expect(place.every((each) => Math.abs(each) <= 100)).toBe(true);
      expect(size.every((each) => each > 0 && each <= 100)).toBe(true);
    }
    expect(model.joints).toHaveLength(links.length);
  }

  it('that was a description before something was changed, cut or repeated gives a model or a fault', () => {
    const whole =
      robot(`<material name="m"><color rgba="1 0.5 0 1"/></material><link name="base_link">${ball}</link>
      <link name="a">${visual('<box size="1 2 0.5"/>', '<origin xyz="0 -1 2" rpy="1 0 -2.5"/>')}</link><link name="b"/>
      ${joint('x', 'revolute', 'base_link', 'a', '<axis xyz="0 0.6 -0.8"/>')}<!-- a comment -->
      ${joint('y', 'prismatic', 'a', 'b', '<mimic joint="x" multiplier="2"/>')}`);
    fc.assert(
      fc.property(
        fc.array(
          fc.tuple(
            fc.nat(whole.length),
            fc.nat(40),
            fc.oneof(fc.string({ maxLength: 6 }), fc.constantFrom('<', '"', '>', '-', '9', '/', '&')),
          ),
          {
            minLength: 1,
            maxLength: 4,
          },
        ),
        (changes) => {
          let text = whole;
          for (const [at, length, put] of changes) text = text.slice(0, at) + put + text.slice(at + length);
          check(text);
        },
      ),
      { numRuns: 500 },
    );
  });
});
