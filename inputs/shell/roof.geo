// A quarter of a shallow cylindrical roof, millimetres: radius 2540, half width 254, half angle 0.1.
R = 2540; L = 254; a = 0.1; n = 8;
Point(1) = {0, 0, 0};                        // axis
Point(2) = {R*Sin(a), R*Cos(a), 0};          // hinged edge
Point(3) = {0, R, 0};                        // crown
Point(4) = {0, 0, L};
Point(5) = {R*Sin(a), R*Cos(a), L};
Point(6) = {0, R, L};
Circle(1) = {2, 1, 3};
Line(2) = {3, 6};
Circle(3) = {6, 4, 5};
Line(4) = {5, 2};
Curve Loop(1) = {1, 2, 3, 4};
Surface(1) = {1};
Transfinite Curve {1, 2, 3, 4} = n + 1;
Transfinite Surface {1};
Recombine Surface {1};
Physical Point("crown") = {3};
Physical Curve("hinge") = {4};
Physical Curve("middle") = {1};              // plane z = 0
Physical Curve("ridge") = {2};               // plane x = 0
Physical Surface("roof") = {1};
