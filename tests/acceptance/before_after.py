# SPDX-License-Identifier: BSD-3-Clause
"""before_after.py OLD NEW: hundreds of commands, run by two programs: exit codes, messages, answers and pictures must be
the same, but for times and memory. Not part of the checks: for redesigns that change no answer. Exit code 0: all
alike."""
import itertools
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORLDS = ROOT / "examples" / "worlds"
BODIES = ['', '--robot point', '--robot "disc 0.1"', '--robot "polygon -0.2 -0.1 0.2 -0.1 0.2 0.1 -0.2 0.1"',
          '--robot "car radius 0.1 turning 0.5"', '--robot "car radius 0.1 turning 0.5 steering reeds-shepp"']
PLANNERS = ['', 'prm', 'lazy-prm', 'visibility', 'cells', 'voronoi', 'rrt', 'rrt-connect', 'grid']
PLACES = {'poly-easy.scene': '--start {0},{0} --goal {1},{1}', 'town.geojson': '--start 1.5,1.5{h} --goal 9.5,8.5{h}',
          'flat.yaml': '--start 0.5,0.5{h} --goal 4.3,0.5{h}', 'maze:11x11': '--start 1,1{h} --goal 11,11{h}'}
OPTIONS = ['--sampler halton', '--sampler lattice', '--sampler corridor', '--samples 300', '--samples auto',
           '--neighbours 6', '--neighbours star', '--radius 1.5', '--radius star --neighbours star', '--search bfs',
           '--search dfs', '--search jump-points', '--search best', '--queue sorted-array', '--queue heap --search bfs',
           '--lazy', '--lazy path', '--pipeline tiled', '--pipeline plain', '--optimise', '--step 0.7', '--goal-bias 0.2',
           '--nodes 500', '--nodes 1', '--trees 3', '--via 5,1', '--via 5,1;5,2', '--via 1,2,3,4', '--cell 0.3', '--cell 0',
           '--angles 36', '--face-motion', '--step-cost 2', '--turn-cost 3', '--diagonal unit', '--layers report004',
           '--full', '--sampled-edges 0.1', '--doors funnel', '--objective clearance', '--steering reeds-shepp',
           '--turning-radius 2', '--attach 0.5,0.2', '--attach 0', '--contact allowed', '--contact blocked',
           '--clearance 0.2', '--clearance -1', '--seed 7', '--seed x', '--planner best', '--samples 0']


def commands():
    solve = 'solve {} {} {} {} --json -'
    for world, places in PLACES.items():
        for body, planner in itertools.product(BODIES, PLANNERS):
            heading = ',0' if 'polygon' in body or 'car' in body else ''
            where = '' if world == 'poly-easy.scene' else places.format(h=heading)
            yield solve.format(world, body, '--planner ' + planner if planner else '', where)
    for world in ['walls.scene', 'car-20.scene', 'parking-lot.scene', 'puma.scene', 'maze:25x25']:
        for planner in PLANNERS:
            yield solve.format(world, '', '--planner ' + planner if planner else '', '--nodes 3000' if 'rrt' in planner else '')
        yield f'solve {world} --optimise --json -'
        yield f'solve {world} --svg out.svg --quiet'
        yield f'solve {world} --optimise --svg out.png --quiet'
        yield f'solve {world} --json a.json --quiet'
        yield f'verify {world} a.json'
        yield f'verify {world} a.json --clearance 0.3'
        yield f'render {world} --answer a.json -o drawn.svg'
        yield f'info {world}'
    for world, planner, option in itertools.product(['maze:11x11', 'town.geojson --start 1.5,1.5 --goal 9.5,8.5',
                                                     'parking-lot.scene'], ['', 'prm', 'rrt', 'grid'], OPTIONS):
        yield f"solve {world} {'--planner ' + planner if planner else ''} {option} --json -"
    for world, planner in itertools.product(['town.geojson --start 1.5,1.5 --goal 9.5,8.5', 'flat.yaml --start 0.5,0.5 --goal 4.3,0.5'],
                                            PLANNERS[1:]):
        yield f'solve {world} --planner {planner} --svg out.svg --quiet'
        yield f'solve {world} --planner {planner} --html out.html --quiet'
    for verb in ['', 'solve', 'verify', 'render', 'info', 'generate', 'convert', 'compare', 'largest', 'scale', 'bench-scen', 'man',
                 'completion']:
        yield f'{verb} --help'
    yield from ['man', 'completion bash', 'completion zsh', 'completion fish', '--version', 'solv', 'solve', 'solve nothing.scene']
    yield 'compare poly-easy.scene --planners rrt,rrt-connect,prm --seeds 3 --json - --quiet'
    yield 'compare maze:11x11 --planners prm,lazy-prm --samples 100,200 --searches astar,dijkstra --seeds 2 --csv - --quiet'
    yield 'compare maze:11x11 --searches dijkstra,astar --queues heap,sorted-array --seeds 2 --quiet'
    yield 'compare town.geojson --start 1.5,1.5 --goal 9.5,8.5 --planners visibility,cells,voronoi,grid --seeds 2 --quiet'
    yield 'compare maze:11x11 --planners prm --doors funnel'
    yield 'compare maze:11x11 --planners nothing'
    yield 'largest --budget 1s --start-size 50 --max-size 50 --quiet'
    yield 'scale --sizes 20,40 --threads 1 --repeats 1 --quiet'
    yield 'scale --sizes 20 --planners prm,lazy-prm --threads 1,2 --repeats 1 --quiet'
    yield 'generate maze 9x9 -o -'
    yield 'generate polygons 20 -o -'
    yield 'convert town.geojson -o -'


NUMBER = r'[-+0-9.eE]+'
VOLATILE = [
    (re.compile(r'"(stages_s|counters_of_the_machine|machine)": \{[^}]*\}'), r'"\1": {}'),
    (re.compile(r'"(solve_s|generate_s|peak_memory_bytes|threads|seconds|[a-z_]*_s|cells_per_s)": ?(' + NUMBER + r'|null)'), r'"\1": 0'),
    (re.compile(r'\d[\d.,\u202f ]* ?(ns|us|µs|ms|s|min|KiB|MiB|GiB|B)\b'), 'T'),
    (re.compile(r'-?\d+(\.\d+)?e-\d+|-?0\.00\d+'), 'small'),
    (re.compile(r'^(  stages|  chain|  solve|  memory| {16}).*$', re.M), ''),
]


def run(program, command, folder):
    result = subprocess.run(f'{program} {command}', shell=True, cwd=folder, capture_output=True, timeout=120)
    text = (result.stdout + b'\n--\n' + result.stderr).decode(errors='replace')
    for pattern, word in VOLATILE:
        text = pattern.sub(word, text)
    files = {}
    for path in sorted(folder.glob('out.*')) + sorted(folder.glob('drawn.*')):
        files[path.name] = path.read_bytes()
        path.unlink()
    return result.returncode, text, files


def main():
    programs = [pathlib.Path(p).resolve() for p in sys.argv[1:3]]
    wanted = re.compile(sys.argv[3] if len(sys.argv) > 3 else '')
    count = different = 0
    with tempfile.TemporaryDirectory() as scratch:
        folders = []
        for name in ('old', 'new'):
            folder = pathlib.Path(scratch) / name
            folder.mkdir()
            for world in WORLDS.iterdir():
                (folder / world.name).write_bytes(world.read_bytes())
            folders.append(folder)
        for command in commands():
            if not wanted.search(command):
                continue
            count += 1
            old, new = (run(p, command, f) for p, f in zip(programs, folders))
            if old == new:
                continue
            different += 1
            print(f'{command}\n  exit {old[0]} and {new[0]}')
            for a, b in itertools.zip_longest(old[1].split('\n'), new[1].split('\n'), fillvalue=''):
                if a != b:
                    print(f'  - {a[:300]}\n  + {b[:300]}')
            print(''.join(f'  {name} differs\n' for name in old[2] if old[2][name] != new[2].get(name)), end='')
    print(f'{count} commands, {different} differ')
    return 1 if different else 0


if __name__ == '__main__':
    sys.exit(main())
