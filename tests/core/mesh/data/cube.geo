// A unit cube, meshed as coarsely as possible. Makes the cube_*.msh files beside it (Gmsh 4.8), MSH being 22 or 41:
//   gmsh -3 -format mshMSH cube.geo -o cube_MSH_ascii.msh
//   gmsh -3 -format mshMSH -bin cube.geo -o cube_MSH_binary.msh
SetFactory("Built-in");
Point(1) = {0, 0, 0, 1};
line[] = Extrude {1, 0, 0} { Point{1}; };
face[] = Extrude {0, 1, 0} { Line{line[1]}; };
box[] = Extrude {0, 0, 1} { Surface{face[1]}; };
